#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A server killed in the middle of a real alteration, and the alteration's own process with it, ends that job after the
# next start: once, with the bytes of a run that nobody disturbed, reading back the stages that were finished.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE" --workers 1 --lease-s 6
test_inputs

# Wait until a job has something to lose: past the first drape, not at its end. One that got past unseen is left to end,
# and a finer one is begun.
for triangles in 12000 16000 20000 24000; do
  options="{\"triangles\":$triangles}"
  job=$(submit alter "$options" | field .id)
  state=queued progress=0
  while [ "$state" = queued ] || [ "$state" = running ]; do
    read -r state progress < <(get "/v1/jobs/$job" | jq -r '"\(.state) \(.progress // 0)"')
    awk "BEGIN { exit !($progress > 0.3 && $progress < 0.95) }" && break 2
    sleep 0.05
  done
done
jobs=$(get /v1/jobs | field '.items | length')
expect "the job in the middle" "$state" running
children=$(pgrep -P "$server" || true)
kill -KILL "$server"
wait "$server" 2> /dev/null || true
for child in $children; do kill -KILL "$child" 2> /dev/null || true; done

start_server "$TOILE" --workers 1 --lease-s 6
wait_for_state "$job" succeeded 120
expect "how often it was begun" "$(get "/v1/jobs/$job" | field .attempt)" 2
expect "jobs in the list" "$(get /v1/jobs | field '.items | length')" "$jobs"
names=$(get "/v1/jobs/$job/artifacts" | field '.items[].name')
expect "files named twice" "$(echo "$names" | sort | uniq -d)" ""
expect "the database" "$(sqlite3 "$data/toile.db" 'PRAGMA integrity_check')" ok
expect "ends in its record" "$(get "/v1/jobs/$job" | field .state)" succeeded
reused=$(get "/v1/jobs/$job/artifacts/timings.json" | field '[.stages[] | select(.reused)] | length')
[ "$reused" -ge 3 ] || fail "only $reused finished stages were read back"

echo "$options" > "$work/options.json"
"$TOILE" --quiet alter --garment "$source_root/schemas/examples/tube_skirt.json" --reference-body builtin:tube-14-100 \
  --target-body builtin:tube-18-100 --options "$work/options.json" --out "$work/command" > /dev/null
for name in $names; do
  [ "$name" = timings.json ] && continue
  get "/v1/jobs/$job/artifacts/$name" > "$work/served"
  cmp "$work/served" "$work/command/$name" || fail "$name differs from that of an undisturbed run"
done
