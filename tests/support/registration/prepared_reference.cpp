// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/registration/prepared_reference.h"

#include <map>

#include "tests/support/shared_body.h"

namespace toile::test {

const RegistrationReference& reference(const std::string& name) {
  static std::map<std::string, RegistrationReference> prepared;
  const auto found = prepared.find(name);
  if (found != prepared.end()) return found->second;
  return prepared.emplace(name, prepare_reference(test::load_shared_body(name))).first->second;
}

}  // namespace toile::test
