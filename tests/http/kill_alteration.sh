#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A server killed in the middle of a real alteration, and the alteration's own process with it, ends that job after the
# next start: once, with the bytes of a run that nobody disturbed, reading back the stages that were finished.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE" --workers 1 --lease-s 6
test_inputs

# Wait until it has something to lose: past the first drape, not at its end. On a busy machine the moment may be missed;
# then a finer one is tried.
for jobs in 1 2 3 4 5 6; do
  options="{\"triangles\":$((8000 + 4000 * jobs))}"
  job=$(submit alter "$options" | field .id)
  for _ in $(seq 4000); do
    progress=$(get "/v1/jobs/$job" | field '.progress // 0')
    awk "BEGIN { exit !($progress > 0.3) }" && break
    sleep 0.05
  done
  kill -STOP "$server"
  children=$(pgrep -P "$server" || true)
  for child in $children; do kill -STOP "$child" 2> /dev/null || true; done
  state=$(sqlite3 -readonly "$data/toile.db" "SELECT state FROM jobs WHERE id = '$job'")
  [ "$state" = running ] && [ -n "$children" ] && awk "BEGIN { exit !($progress < 0.95) }" && break
  kill -CONT "$server" $children 2> /dev/null || true
  state=missed
done
expect "the job in the middle" "$state" running
kill -KILL "$server"
wait "$server" 2> /dev/null || true
for child in $children; do kill -KILL "$child" 2> /dev/null || true; done

start_server "$TOILE" --workers 1 --lease-s 6
wait_for_state "$job" succeeded
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
