#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What clients rely on: waiting, idempotency, ETags, ranges, events, long poll, cursors, labels, cancellation, batches.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE_TESTING" --workers 2
test_inputs

done_job=$(submit write '{}' -H 'Prefer: wait=30' -D "$work/head")
grep -qi '^Preference-Applied: wait=30' "$work/head" || fail "Prefer was not applied"
expect "a waited-for job" "$(echo "$done_job" | field .state)" succeeded
id=$(echo "$done_job" | field .id)

expect "the same body again" "$(status -X POST "${json[@]}" -d '{"builtin":"tube-14-100"}' "$url/v1/bodies")" 200

key=(-H "Idempotency-Key: order-17")
first=$(submit write '{"bytes":17}' "${key[@]}" | field .id)
second=$(submit write '{"bytes":17}' "${key[@]}" | field .id)
expect "a repeated request" "$second" "$first"
expect "another payload under the same key" "$(submit write '{"bytes":18}' "${key[@]}" -o /dev/null -w '%{http_code}')" 422

# A key whose first request still waits for its job.
submit sleep "{\"until\":\"$work/on\"}" -H "Idempotency-Key: order-19" -H 'Prefer: wait=60' > "$work/waited" &
first=$!
for _ in $(seq 600); do [ "$(get '/v1/jobs?state=running' | field '.items | length')" = 1 ] && break; sleep 0.1; done
expect "a key in flight" "$(submit sleep "{\"until\":\"$work/on\"}" -H "Idempotency-Key: order-19" -o /dev/null -w '%{http_code}')" 409
touch "$work/on"
wait "$first"
expect "the first request with it" "$(field .state < "$work/waited")" succeeded
expect "the key afterwards" "$(submit sleep "{\"until\":\"$work/on\"}" -H "Idempotency-Key: order-19" | field .id)" "$(field .id < "$work/waited")"

artifact=$url/v1/jobs/$id/artifacts/filler.bin
tag=$(curl -sSI "$artifact" | tr -d '\r' | sed -n 's/^ETag: //p')
expect "the ETag" "$tag" "\"$(curl -sS "$artifact" | sha256sum | cut -d' ' -f1)\""
expect "unchanged bytes" "$(status -H "If-None-Match: $tag" "$artifact")" 304
curl -sS "$artifact" > "$work/whole"
expect "a range" "$(curl -sS -r 10-19 -o "$work/part" -D "$work/head" -w '%{http_code}' "$artifact")" 206
cmp "$work/part" <(tail -c +11 "$work/whole" | head -c 10) || fail "other bytes than asked for"
grep -qi "^Content-Range: bytes 10-19/$(stat -c %s "$work/whole")" "$work/head" || fail "no Content-Range: $(cat "$work/head")"
expect "a range of another file" "$(status -r 10-19 -H 'If-Range: "no"' "$artifact")" 200
head -c 20 "$work/whole" > "$work/resumed"
curl -sS -C - -o "$work/resumed" "$artifact"
cmp "$work/whole" "$work/resumed" || fail "a download that was broken off does not go on"
expect "a range past the end" "$(curl -sS --max-time 20 -r 999999999- "$artifact" | field '.status, .code' | xargs)" "416 no_such_range"
jobtag=$(curl -sSI "$url/v1/jobs/$id" | tr -d '\r' | sed -n 's/^ETag: //p')
expect "an unchanged job" "$(status -H "If-None-Match: $jobtag" "$url/v1/jobs/$id")" 304
expect "the request id" "$(curl -sSI -H 'X-Request-Id: shop-1' "$url/healthz" | tr -d '\r' | sed -n 's/^X-Request-Id: //p')" shop-1

for _ in $(seq 100); do grep -q '"request":"shop-1"' "$work/log" && break; sleep 0.1; done
grep -q '"request":"shop-1".*"route":"/healthz"' "$work/log" || fail "the request's id is not in the log"

# Events end with the job; who comes back with the last id misses nothing.
slow=$(submit sleep "{\"until\":\"$work/go\"}" | field .id)
curl -sSN --max-time 280 "$url/v1/jobs/$slow/events" > "$work/events" &
stream=$!
wait_for_state "$slow" running
for _ in $(seq 600); do [ "$(grep -c '^id:' "$work/events")" -ge 2 ] && break; sleep 0.1; done
touch "$work/go"
wait "$stream"
expect "the last event" "$(grep '^event:' "$work/events" | tail -1)" "event: succeeded"
[ "$(grep -c '^id:' "$work/events")" -ge 3 ] || fail "too few events: $(cat "$work/events")"
last=$(grep '^id:' "$work/events" | tail -1 | cut -d' ' -f2)
expect "events after a reconnect" "$(curl -sSN --max-time 280 -H "Last-Event-ID: $((last - 1))" "$url/v1/jobs/$slow/events" | grep -c '^id:')" 1
expect "the long poll" "$(get "/v1/jobs/$slow/events?wait=5&last_event_id=$((last - 1))" | field .event)" succeeded

# Cancellation ends what would run for minutes (how fast: tests/stress/service_load).
run=$(submit sleep '{"ms":600000}' | field .id)
submit sleep '{"ms":600001}' > /dev/null
wait=$(submit sleep '{"ms":600002}' | field .id)
wait_for_state "$run" running
expect "a cancelled queued job" "$(curl -sS -X DELETE "$url/v1/jobs/$wait" | field .state)" cancelled
started=$(date +%s)
expect "a cancelled running job" "$(curl -sS -X DELETE "$url/v1/jobs/$run" | field .state)" cancelled
[ $(($(date +%s) - started)) -lt 60 ] || fail "cancelling took longer than a minute"
for job in $(get '/v1/jobs?state=running' | field '.items[].id'); do curl -sS -X DELETE "$url/v1/jobs/$job" > /dev/null; done

# Labels make a catalogue; lists are paged.
for n in 1 2 3 4 5; do
  post /v1/bodies "{\"builtin\":\"tube-1$n-90\",\"labels\":[\"spring\",\"no$n\"]}" > /dev/null
done
expect "labelled bodies" "$(get '/v1/bodies?label=spring' | field '.items | length')" 5
page=$(get '/v1/bodies?label=spring&limit=3')
expect "a page" "$(echo "$page" | field '.items | length')" 3
expect "the next page" "$(get "$(echo "$page" | field .next)" | field '.items | length')" 2

batch=$(post /v1/batches "{\"garment\":\"$garment\",\"reference_body\":\"$body\",\"label\":\"spring\",\"options\":{\"triangles\":500}}")
batch_id=$(echo "$batch" | field .id)
expect "jobs of the batch" "$(echo "$batch" | field .counts.total)" 5
for _ in $(seq 1500); do
  batch=$(get "/v1/batches/$batch_id")
  [ "$(echo "$batch" | field '.counts.queued + .counts.running')" = 0 ] && break
  sleep 0.2
done
expect "batch jobs that ended well" "$(echo "$batch" | field .counts.succeeded)" 5
expect "rows of the fit matrix" "$(echo "$batch" | field '[.fit_matrix[] | select(.fit | length > 0)] | length')" 5
table=$(get "$(echo "$batch" | field .links.table)")
expect "the head of the table" "$(echo "$table" | head -1 | cut -d, -f1-4)" "body,id,status,error"
expect "bodies in the table" "$(echo "$table" | grep -c ',done,')" 5
get "$(echo "$batch" | field .links.page)" > "$work/page"
expect "reports the page leads to" "$(grep -c '/artifacts/report.html' "$work/page")" 5
expect "one of them" "$(status "$url/v1/batches/x/$(grep -o '"[^"]*report.html' "$work/page" | head -1 | tr -d '"')")" 200
expect "batches listed" "$(get /v1/batches | field '.items | length')" 1

get /metrics > "$work/said"  # grep -q hangs up early, which curl calls a failure
grep -q 'toile_jobs{state="succeeded"} [1-9]' "$work/said" || fail "no metrics"
expect "readiness" "$(status "$url/readyz")" 200
get /openapi.yaml > "$work/said"
head -1 "$work/said" | grep -q 'openapi: 3.1' || fail "no interface description"
stop_server
expect "the exit code on SIGTERM" "$stopped" 0
