#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# After a body is deleted no byte string of it, nor of what was made from it, nor their hashes, are in files or logs.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE_TESTING" --workers 2
test_inputs
/usr/bin/python3 - "$work" << 'PY'
import math, random, sys
random.seed(5)
out = open(sys.argv[1] + "/scan.obj", "w")
rings, around = 60, 24
for j in range(rings + 1):
    for i in range(around):
        a = 2 * math.pi * i / around
        out.write("v %.6f %.6f %.6f\n" % (0.2 * math.cos(a) + random.uniform(-1e-4, 1e-4), 1.7 * j / rings, 0.15 * math.sin(a)))
for j in range(rings):
    for i in range(around):
        a, b = j * around + i + 1, j * around + (i + 1) % around + 1
        out.write("f %d %d %d\nf %d %d %d\n" % (a, a + around, b, b, a + around, b + around))
PY
scan=$(curl -sS -F file=@"$work/scan.obj" -F kind=form "$url/v1/bodies")
target=$(echo "$scan" | field .id)
[ "$target" != null ] || fail "the scan was refused: $scan"
reference=$body
body=$target # as both bodies: the stage and the artifact hold its bytes
for n in 1 2 3; do
  job=$(submit copy "{\"n\":$n}" -H 'Prefer: wait=60')
  expect "a job on the scan" "$(echo "$job" | field .state)" succeeded
done
grep -a '^v ' "$work/scan.obj" | shuf -n 1000 --random-source=<(yes) | cut -d' ' -f2- > "$work/known"
sha256sum "$work/scan.obj" | cut -d' ' -f1 >> "$work/known"
grep -rqaFf "$work/known" "$data" || fail "the search does not find what is there"
expect "the deletion" "$(status -X DELETE "$url/v1/bodies/$target")" 204
expect "the body" "$(status "$url/v1/bodies/$target")" 404
expect "the job" "$(status "$url/v1/jobs/$(echo "$job" | field .id)")" 404
if grep -rlaFf "$work/known" "$data" "$work/log"; then fail "something of the scan is left"; fi
if find "$data" -type f | grep -Ff "$work/known"; then fail "a file is named after the scan"; fi
expect "the other body" "$(status "$url/v1/bodies/$reference")" 200
expect "the database" "$(sqlite3 "$data/toile.db" 'PRAGMA integrity_check')" ok
