// SPDX-License-Identifier: GPL-3.0-or-later
// A garment and bodies to try the service with.
#pragma once

#include <string>

#include "jobs/store/store.h"

namespace toile::app {

// Stores the tube skirt and three forms for the tenant `default`; again and again is as once. Answers curl lines that
// make a job of them, wait for it and fetch a picture from the server at `url`.
std::string store_demo(Store& store, const std::string& url);

}  // namespace toile::app
