#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A full disk, at any write: requests get 507, jobs fail or wait, the server stays up and the database sound; when there
# is space again, work goes on.
. "$(dirname "$0")/lib.sh"
full=$work/full
export TOILE_TEST_DISK_FULL=$full
LD_PRELOAD=$TOILE_FULL_DISK start_server "$TOILE_TESTING" --workers 1
test_inputs
running=$(submit sleep "{\"until\":\"$work/go\"}" | field .id)
wait_for_state "$running" running
touch "$full"
for n in 1 2 3; do
  expect "a job on a full disk" "$(submit write "{\"bytes\":$n}" -o "$work/answer" -w '%{http_code}')" 507
done
expect "its code" "$(field .code < "$work/answer")" storage_full
expect "an upload on a full disk" "$(status -F file=@"$source_root/README.md" "$url/v1/bodies")" 507
expect "reading goes on" "$(status "$url/v1/jobs/$running")" 200
touch "$work/go" # the job ends while nothing can be written
sleep 2
kill -0 "$server" || fail "the server died"
rm "$full"
wait_for_state "$running" succeeded
expect "a job with space again" "$(submit write '{}' -H 'Prefer: wait=60' | field .state)" succeeded
expect "the database" "$(sqlite3 "$data/toile.db" 'PRAGMA integrity_check')" ok
expect "the tries are told" "$([ "$(get "/v1/jobs/$running" | field .attempt)" -ge 1 ] && echo yes)" yes
