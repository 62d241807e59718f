#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# An altered garment altered back: a job's target_pattern.json with its target_worn.obj beside it, as the command line
# does with --worn; a file that does not belong to the pattern is refused by the job, an id that is not there at once.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE" --workers 1
test_inputs
options='{"triangles":1000,"outputs":["target_pattern.json","target_worn.obj"]}'
there=$(submit alter "$options" -H 'Prefer: wait=60' | field .id)
for name in target_pattern.json target_worn.obj; do get "/v1/jobs/$there/artifacts/$name" > "$work/$name"; done
derived=$(curl -sS -F file=@"$work/target_pattern.json" "$url/v1/garments" | field .id)
worn=$(curl -sS -F file=@"$work/target_worn.obj" "$url/v1/garments" | field .id)

request() { # request GARMENT WORN: the way back
  printf '{"garment":"%s","worn":"%s","reference_body":"%s","target_body":"%s","options":%s}' \
    "$1" "$2" "$target" "$body" "$options"
}
back=$(post /v1/jobs "$(request "$derived" "$worn")" -H 'Prefer: wait=60')
expect "the way back" "$(echo "$back" | field '.state + " " + .worn')" "succeeded $worn"
echo "$options" > "$work/options.json"
"$TOILE" --quiet alter --garment "$work/target_pattern.json" --worn "$work/target_worn.obj" --options "$work/options.json" \
  --reference-body builtin:tube-18-100 --target-body builtin:tube-14-100 --out "$work/command" > /dev/null
"$TOILE" --quiet alter --garment "$work/target_pattern.json" --options "$work/options.json" \
  --reference-body builtin:tube-18-100 --target-body builtin:tube-14-100 --out "$work/without" > /dev/null
get "/v1/jobs/$(echo "$back" | field .id)/artifacts/target_pattern.json" > "$work/served"
cmp "$work/served" "$work/command/target_pattern.json" || fail "the command makes another pattern"
! cmp -s "$work/served" "$work/without/target_pattern.json" || fail "it makes no difference"

foreign=$(post /v1/jobs "$(request "$garment" "$worn")" -H 'Prefer: wait=60')
expect "a file of another pattern" "$(echo "$foreign" | field '.error.code')" garment_invalid
expect "a body as what is worn" "$(post /v1/jobs "$(request "$derived" "$body")" -o /dev/null -w '%{http_code}')" 422
post /v1/jobs "$(request "$derived" garment_00000000000000000000000000000000)" > "$work/refused"
expect "a file that is not there" "$(field '.errors[0].pointer' < "$work/refused")" /worn
batch=$(post /v1/batches "{\"garment\":\"$derived\",\"worn\":\"$worn\",\"reference_body\":\"$target\",\"target_bodies\":[\"$body\"],\"options\":$options}")
expect "the same way back in a batch" "$(get /v1/jobs | field '.items[0].state')" succeeded
expect "its counts" "$(get "/v1/batches/$(echo "$batch" | field .id)" | field .counts.succeeded)" 1
expect "what is worn, deleted" "$(status -X DELETE "$url/v1/garments/$worn")" 204
expect "and the job with it" "$(status "$url/v1/jobs/$(echo "$back" | field .id)")" 404
