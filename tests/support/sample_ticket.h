// SPDX-License-Identifier: GPL-3.0-or-later
// A work order with every kind of entry, for tests of the documents.
#pragma once

#include "engine/core/ticket.h"

namespace toile::test {

Ticket sample_ticket();

}  // namespace toile::test
