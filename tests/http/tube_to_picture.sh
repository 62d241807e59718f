#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From nothing to the picture: garment, two bodies, a job, its files; the same bytes as `toile alter` gives.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE" --workers 1

garment=$(curl -sS -F file=@"$source_root/schemas/examples/tube_skirt.json" "$url/v1/garments" | jq -r .id)
reference=$(post /v1/bodies '{"builtin":"tube-14-100"}' | jq -r .id)
target=$(post /v1/bodies '{"builtin":"tube-18-100"}' | jq -r .id)
request="{\"garment\":\"$garment\",\"reference_body\":\"$reference\",\"target_body\":\"$target\"}"
job=$(post /v1/jobs "$request" | jq -r .id)
for _ in $(seq 1500); do
  state=$(get "/v1/jobs/$job" | jq -r .state)
  [ "$state" = queued ] || [ "$state" = running ] || break
  sleep 0.2
done
expect "the job's end" "$state" succeeded

curl -sS -o "$work/fit.png" "$url/v1/jobs/$job/artifacts/fit_before.png"
expect "the picture's first bytes" "$(head -c 4 "$work/fit.png" | tail -c 3)" PNG

"$TOILE" --quiet alter --garment "$source_root/schemas/examples/tube_skirt.json" --reference-body builtin:tube-14-100 \
  --target-body builtin:tube-18-100 --out "$work/command" > /dev/null
count=0
for name in $(get "/v1/jobs/$job/artifacts" | jq -r '.items[].name'); do
  [ "$name" = timings.json ] && continue
  get "/v1/jobs/$job/artifacts/$name" > "$work/served"
  # The names of the inputs stand in result.json: a built-in body has the same one here and there.
  cmp "$work/served" "$work/command/$name" || fail "$name differs between the command and the server"
  count=$((count + 1))
done
[ "$count" -ge 4 ] || fail "only $count files were compared"

# A wider tube wants one strip.
get "/v1/jobs/$job/artifacts/ticket.json" > "$work/ticket"
expect "the operations" "$(jq -c '[.operations[].op]' "$work/ticket")" '["insert_strip"]'

# The same job again answers at once, from what is known.
expect "an equal job" "$(post /v1/jobs "$request" -o /dev/null -w '%{http_code}')" 200
# Another job on the same reference reads its drape back instead of computing it.
again=$(post /v1/jobs "${request%\}},\"options\":{\"stretch_limit\":0.04}}" -H 'Prefer: wait=60')
expect "the second job" "$(echo "$again" | jq -r .state)" succeeded
reused=$(get "/v1/jobs/$(echo "$again" | jq -r .id)/artifacts/timings.json" | jq '[.. | objects | select(.reused == true)] | length')
[ "$reused" -ge 3 ] || fail "only $reused stages were read back"
