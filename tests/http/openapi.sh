#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The interface's description against the running server: every documented call is made, every answer is one that is
# documented and agrees with its schema.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE_TESTING" --workers 1
/usr/bin/python3 "$here/openapi.py" "$url" "$TOILE" "$source_root" "$work" || fail "see above"
