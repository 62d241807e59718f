#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Jobs that abort, segfault, loop for ever or eat memory end alone, within their limits, each with its class.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE_TESTING" --workers 4 --job-memory-mb 512 --job-cpu-s 2 --job-wall-s 120
test_inputs
declare -A wanted=([crash]="failed crashed" [segfault]="failed crashed" [loop]="failed timed_out"
  [allocate]="failed resource_limit" [fail]="failed garment_invalid" [write]="succeeded null")
declare -A ids
for kind in "${!wanted[@]}"; do ids[$kind]=$(submit "$kind" '{}' | field .id); done
for kind in "${!wanted[@]}"; do
  for _ in $(seq 2000); do
    found=$(get "/v1/jobs/${ids[$kind]}" | field '.state + " " + (.error.code // "null")')
    case $found in queued* | running*) sleep 0.1 ;; *) break ;; esac
  done
  expect "a job that does $kind" "$found" "${wanted[$kind]}"
done
expect "tries of a crashing job" "$(get "/v1/jobs/${ids[crash]}" | field .attempt)" 2
expect "the server" "$(status "$url/readyz")" 200
# A job slower than its wall time.
stop_server
start_server "$TOILE_TESTING" --workers 1 --job-wall-s 1
slow=$(submit sleep '{"ms":20000}' -H 'Prefer: wait=60')
expect "a slow job" "$(echo "$slow" | field .error.code)" timed_out
# The shipped program knows none of these kinds.
stop_server
start_server "$TOILE" --workers 1
expect "a test kind in the shipped program" "$(submit crash '{}' -o /dev/null -w '%{http_code}')" 422
