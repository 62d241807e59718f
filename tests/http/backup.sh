#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# deploy/backup of a running server, restored as deploy/README.md says: jobs, files and waiting work are there again. What
# is deleted leaves the backup with its next run.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE_TESTING" --workers 1 --drain-s 1 --lease-s 2
test_inputs
done_job=$(submit write '{"bytes":5000}' -H 'Prefer: wait=60' | field .id)
copied=$(submit copy '{}' -H 'Prefer: wait=60' | field .id)
running=$(submit sleep "{\"until\":\"$work/go\"}" | field .id)
wait_for_state "$running" running
get "/v1/jobs/$done_job/artifacts/filler.bin" > "$work/file"
copy="$work/a backup"
bash "$source_root/deploy/backup" "$data" "$copy" > "$work/said"
grep -q ' 0 deleted meanwhile' "$work/said" || fail "$(cat "$work/said")"

secret=$(get "/v1/jobs/$copied/artifacts" | field '.items[] | select(.name == "copy.bin") | .sha256')
[ -f "$copy/blobs/$secret" ] || fail "the backup lacks a file"
expect "the deletion" "$(status -X DELETE "$url/v1/bodies/$target")" 204
cp -r "$copy" "$work/before"
bash "$source_root/deploy/backup" "$data" "$copy" > /dev/null
[ ! -f "$copy/blobs/$secret" ] || fail "a deleted file lives on in the backup"
grep -qaF "$target" "$copy/toile.db" && fail "a deleted body lives on in the backup's database"

stop_server
touch "$work/go"
data=$work/restored
mkdir "$data"
cp -r "$work/before/toile.db" "$work/before/blobs" "$data"
start_server "$TOILE_TESTING" --workers 1 --drain-s 1 --lease-s 2
get "/v1/jobs/$done_job/artifacts/filler.bin" | cmp - "$work/file" || fail "another file than before"
wait_for_state "$running" succeeded
