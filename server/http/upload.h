// SPDX-License-Identifier: GPL-3.0-or-later
// A body or a garment as it comes in: multipart (a `file` and fields) or JSON. The bytes go straight to a file.
#pragma once

#include "server/http/service.h"

namespace toile::http {

struct Upload {
  NewInput input;
  PreparedBlob blob;
};

// Throws Problem: 413, 415, 400, 422; Error{StorageFull}.
Upload read_upload(Service& service, Request& request, InputKind kind);

}  // namespace toile::http
