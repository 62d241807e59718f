#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A server killed in mid-job and started again ends the job, once. SIGTERM gives running work back and exits with 0.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE_TESTING" --workers 1
test_inputs
job=$(submit sleep "{\"until\":\"$work/go\"}" | field .id)
wait_for_state "$job" running
kill -KILL "$server"
wait "$server" 2> /dev/null || true
touch "$work/go"
start_server "$TOILE_TESTING" --workers 1
wait_for_state "$job" succeeded
expect "how often it was begun" "$(get "/v1/jobs/$job" | field .attempt)" 2
expect "its files" "$(get "/v1/jobs/$job/artifacts" | field '.items | length')" 1
expect "the database" "$(sqlite3 "$data/toile.db" 'PRAGMA integrity_check')" ok

kill -KILL "$server"
wait "$server" 2> /dev/null || true
start_server "$TOILE_TESTING" --workers 1 --drain-s 1
job=$(submit sleep '{"ms":60000}' | field .id)
wait_for_state "$job" running
started=$(date +%s)
stop_server
expect "the exit code" "$stopped" 0
[ $(($(date +%s) - started)) -le 40 ] || fail "draining took too long"
expect "the job after the drain" "$(sqlite3 "$data/toile.db" "SELECT state FROM jobs WHERE id = '$job'")" queued
expect "scratch folders left" "$(find "$data/scratch" -mindepth 1 | wc -l)" 0

# A separate worker works off what a server took in.
start_server "$TOILE_TESTING" --workers 1
curl -sS -X DELETE "$url/v1/jobs/$job" > /dev/null
"$TOILE_TESTING" work --data "$data" --workers 2 2>> "$work/log" &
others+=($!)
for n in 1 2 3 4 5 6; do submit sleep "{\"ms\":20$n}" > /dev/null; done
for _ in $(seq 1200); do
  left=$(get /v1/jobs | field '[.items[] | select(.state == "queued" or .state == "running")] | length')
  [ "$left" = 0 ] && break
  sleep 0.1
done
expect "jobs left" "$left" 0
for _ in $(seq 600); do
  seen=$(get /metrics | sed -n 's/^toile_workers //p')
  [ "$seen" = 2 ] && break
  sleep 0.1
done
expect "workers seen" "$seen" 2
