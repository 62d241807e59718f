// SPDX-License-Identifier: GPL-3.0-or-later
// What is measured on a scan through the shipped mannequin, beside the same measures of the body it was made of.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/measure_scan.h"
#include "tests/bench/bench.h"
#include "tests/bench/register_tables.h"
#include "tests/support/registration/posed_body.h"
#include "tests/support/registration/registration_score.h"

namespace toile::bench {
namespace {

MeasureBodyResult measured(TriangleMesh body) {
  body.vertices.col(1).array() -= body.vertices.col(1).minCoeff();  // a scan's frame has no soles to stand on
  return measure_body(body, find_skeleton(body).skeleton);
}

}  // namespace

test::RegistrationCase find_case(const std::string& name) {
  if (name.starts_with("scan_")) return test::scan_case(name);
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos) return test::shuffled_case(name);
  return test::variant_case(name.substr(0, colon), static_cast<unsigned>(std::atoi(name.c_str() + colon + 1)));
}

int bench_register_measures(const Arguments& arguments) {
  std::vector<std::string> names(arguments.words.begin() + 1, arguments.words.end());
  if (names.empty()) names = {"scan_a", "scan_b", "scan_c", "scan_d"};
  std::map<std::string, std::vector<std::string>> rows;
  std::vector<std::string> columns = {"mm"};
  for (const std::string& name : names) {
    for (const char* column : {" true", " off"}) columns.push_back(name + column);
    const test::RegistrationCase known = find_case(name);
    const Measurements found = measure_scan(known.target).measured.measurements;
    for (const auto& [measure_name, value] : measured(known.truth).measurements) {
      std::vector<std::string>& row = rows[measure_name];
      if (row.empty()) row.push_back(measure_name);
      row.push_back(fixed(value * 1e3, 1)), row.push_back(fixed((found.at(measure_name) - value) * 1e3, 1));
    }
  }
  Table table(columns);
  for (auto& [name, row] : rows) table.add(std::move(row));
  table.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench
