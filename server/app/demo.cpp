// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/demo.h"

#include "server/app/demo_garment.h"

namespace toile::app {

namespace {

std::string add(Store& store, InputKind kind, const std::string& name, const std::string& fields,
                const std::string& text) {
  const PreparedBlob blob =
      store.artifacts.prepare(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  store.artifacts.publish(std::span(&blob, 1));
  Transaction transaction(store.database);
  const std::string id = store.inputs.add(transaction, {"default", kind, name, fields, "{}", {"demo"}}, blob).first.id;
  transaction.commit();
  return id;
}

}  // namespace

std::string store_demo(Store& store, const std::string& url) {
  const std::string garment =
      add(store, InputKind::Garment, "tube_skirt.json", R"({"format":"json"})", demo_garment_text());
  std::vector<std::string> forms;
  for (const char* form : {"tube-14-100", "tube-16-100", "tube-18-100"})
    forms.push_back(add(store, InputKind::Body, form, R"({"format":"builtin"})", form));
  return "job=$(curl -s " + url +
         "/v1/jobs -H 'Content-Type: application/json' \\\n"
         "  -d '{\"garment\":\"" +
         garment + "\",\"reference_body\":\"" + forms.front() + "\",\"target_body\":\"" + forms.back() +
         "\"}' | jq -r .id)\n"
         "curl -sN " +
         url +
         "/v1/jobs/$job/events | grep ^event: | uniq  # until it has ended\n"
         "curl -s -o fit.png " +
         url + "/v1/jobs/$job/artifacts/fit_before.png\n";
}

}  // namespace toile::app
