// SPDX-License-Identifier: GPL-3.0-or-later
// A job as a client describes it, checked: kind, inputs, options, labels, webhook.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/http/service.h"

namespace toile::http {

// Throws Problem 422 with a JSON pointer; Error of the options check.
NewJob read_job_request(const Service& service, const std::string& tenant, const nlohmann::json& document);
// `options` of a job or a batch as canonical text with all defaults written out.
std::string read_options(const Service& service, const std::string& kind, const nlohmann::json& document);
std::optional<std::string> read_webhook(const Service& service, const nlohmann::json& document);
// The string at `name`. Throws Problem 422 when it is missing or of another type.
std::string required_text(const nlohmann::json& document, const std::string& name);
// Throws Error{StorageFull} when less than ServiceOptions::min_free_bytes are left.
void refuse_when_disk_is_low(const Service& service);

}  // namespace toile::http
