#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Hostile traffic: each kind gets its refusal, the server stays small, an honest client is answered in time.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE_TESTING" --workers 1
test_inputs
job=$(submit write '{"bytes":2000000}' -H 'Prefer: wait=60' | field .id)
/usr/bin/python3 "$here/hostile.py" "$(cat "$work/port")" "$server" "$job" || fail "see above"
expect "readiness afterwards" "$(status "$url/readyz")" 200
