// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the command line: whole in, whole out.
#pragma once

#include <filesystem>
#include <string>

#include "engine/core/types.h"

namespace toile::app {

// Largest input file that is read at all; the importers have limits of their own below it.
inline constexpr std::uintmax_t kMostInputBytes = 64u << 20;

// The folder of --out, made if needed. Throws BadUsage when no file can be written there: before any work is done.
void prepare_folder(const std::filesystem::path& folder);

// "-" is standard input. Throws FileUnreadable (no such file, a folder, no permission) and LimitExceeded.
Bytes read_file(const std::string& path);

// Writes beside and renames, so that a file is there whole or not at all; makes the folder if needed. Devices, pipes
// and links are written into. Throws StorageFull when the disk is, else StorageFailed.
void write_file(const std::filesystem::path& path, const Bytes& bytes);

// Throws the same when a file behind `>` has not taken all that was printed; a reader that has had enough (`| head`)
// is no failure.
void check_standard_output();

}  // namespace toile::app
