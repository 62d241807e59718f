#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Random SIGKILLs of the server, a worker beside it and the jobs' processes while jobs come in. TOILE_KILLS and
# TOILE_JOBS set the size; tests/stress/kill_jobs is the long version.
. "$(dirname "$0")/lib.sh"
kills=${TOILE_KILLS:-25}
jobs=${TOILE_JOBS:-60}
RANDOM=17
flags=(--workers 1 --lease-s 6 --drain-s 1)
start_server "$TOILE_TESTING" "${flags[@]}"
test_inputs
worker=
start_worker() {
  "$TOILE_TESTING" work --data "$data" "${flags[@]}" 2>> "$work/log" &
  worker=$!
  others=("$worker")
}
start_worker

# Hands in job N under a key, until a 202 or 200 is seen: whoever got an answer must find the job at the end.
hand_in() {
  local answer
  for _ in $(seq 400); do
    answer=$(curl -sS --max-time 10 -X POST "${json[@]}" -H "Idempotency-Key: job-$1" \
      -d "$(job_text sleep "{\"ms\":$((10 + $1 % 90)),\"n\":$1}")" "$(cat "$work/url")/v1/jobs" 2> /dev/null) || true
    id=$(echo "$answer" | jq -r '.id // empty' 2> /dev/null) || true
    [ -n "$id" ] && echo "$id" >> "$work/ids" && return 0
    sleep 0.1
  done
  echo "job $1 was never taken" >> "$work/missed"
}
echo "$url" > "$work/url"
(for n in $(seq "$jobs"); do hand_in "$n"; done; touch "$work/all-in") &
others+=($!)
feeder=$!

for n in $(seq "$kills"); do
  sleep "0.$((RANDOM % 4))$((RANDOM % 10))"
  case $((RANDOM % 3)) in
    0)
      kill -KILL "$server" 2> /dev/null || true
      wait "$server" 2> /dev/null || true
      start_server "$TOILE_TESTING" "${flags[@]}"
      echo "$url" > "$work/url"
      ;;
    1)
      kill -KILL "$worker" 2> /dev/null || true
      wait "$worker" 2> /dev/null || true
      start_worker
      others+=("$feeder")
      ;;
    2)
      for process in $(pgrep -P "$server,$worker" 2> /dev/null | shuf -n 1); do kill -KILL "$process" 2> /dev/null || true; done
      ;;
  esac
done
wait "$feeder" 2> /dev/null || true
started=$(date +%s)
for _ in $(seq 3000); do
  left=$(sqlite3 -readonly "$data/toile.db" "SELECT count(*) FROM jobs WHERE state IN ('queued','running')" 2> /dev/null || echo 1)
  [ "$left" = 0 ] && break
  sleep 0.1
done
[ ! -f "$work/missed" ] || fail "$(cat "$work/missed")"
expect "jobs left" "$left" 0
stop_server
kill -TERM "$worker"
wait "$worker" || true
ask() { sqlite3 -readonly "$data/toile.db" "$1"; }
expect "answers" "$(wc -l < "$work/ids")" "$jobs"
expect "different jobs" "$(sort -u "$work/ids" | wc -l)" "$jobs"
expect "jobs in the database" "$(ask 'SELECT count(*) FROM jobs')" "$jobs"
# Each end of a job writes its artifact once; the log tells every end that was accepted.
ask "SELECT id, state, attempt, error_code, error_message FROM jobs WHERE state <> 'succeeded'" >&2
expect "succeeded" "$(ask "SELECT count(*) FROM jobs WHERE state = 'succeeded'")" "$jobs"
expect "artifacts" "$(ask 'SELECT count(*) FROM artifacts')" "$jobs"
expect "ended twice" "$(jq -rR 'fromjson? | select(.event == "job_ended" and .outcome == "succeeded") | .job' "$work/log" | sort | uniq -d | wc -l)" 0
expect "integrity" "$(ask 'PRAGMA integrity_check')" ok
missing=0
for sha in $(ask 'SELECT sha256 FROM blobs'); do
  [ "$(sha256sum < "$data/blobs/$sha" | cut -d' ' -f1)" = "$sha" ] || missing=$((missing + 1))
done
expect "damaged files" "$missing" 0
echo "$kills kills, $jobs jobs: all ended once; tries in all $(ask 'SELECT sum(attempt) FROM jobs'), most for one job" \
  "$(ask 'SELECT max(attempt) FROM jobs'); the last ended $(($(date +%s) - started)) s after the last job came in"
