#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The curl lines that `toile serve --demo` prints work as they stand.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE" --workers 1 --demo > "$work/said"
for _ in $(seq 600); do grep -q fit.png "$work/said" && break; sleep 0.1; done
expect "the lines" "$(grep -c '^job=\|^curl\|^  -d' "$work/said")" 4
(cd "$work" && bash -euo pipefail "$work/said" > "$work/shown")
expect "the job" "$(tail -n 1 "$work/shown")" "event: succeeded"
expect "the picture's first bytes" "$(head -c 4 "$work/fit.png" | tail -c 3)" PNG
