// SPDX-License-Identifier: GPL-3.0-or-later
// A quick look at strangers' bytes, in a limited child process of its own: a parser that fails takes nothing with it.
#pragma once

#include "jobs/worker/attempt.h"
#include "jobs/worker/child_protocol.h"

namespace toile {

// Runs `request` to its end and answers its summary. Throws the Error the child told; LimitExceeded when it needed too
// much time or memory; FileMalformed when it crashed.
std::string inspect_in_child(Store& store, const JobRequest& request, const AttemptOptions& options);

}  // namespace toile
