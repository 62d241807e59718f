#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# API keys: nobody comes in without one, nobody sees what is another tenant's.
. "$(dirname "$0")/lib.sh"
printf 'alice %s\n# a comment\nbob %s\n' "$(printf alice-key | sha256sum | cut -d' ' -f1)" \
  "$(printf bob-key | sha256sum | cut -d' ' -f1)" > "$work/keys"
start_server "$TOILE_TESTING" --workers 1 --api-keys "$work/keys"
alice=(-H "Authorization: Bearer alice-key")
bob=(-H "X-Api-Key: bob-key")

expect "no key" "$(status "$url/v1/jobs")" 401
expect "a wrong key" "$(status -H 'Authorization: Bearer no' "$url/v1/jobs")" 401
curl -sSI "$url/v1/jobs" > "$work/said"
grep -qi '^WWW-Authenticate: Bearer' "$work/said" || fail "no WWW-Authenticate"
expect "health needs no key" "$(status "$url/healthz")" 200

test_inputs "${alice[@]}"
job=$(submit write '{}' "${alice[@]}" -H 'Prefer: wait=60' | field .id)
expect "the owner's job" "$(status "${alice[@]}" "$url/v1/jobs/$job")" 200
for path in "/v1/bodies/$body" "/v1/garments/$garment" "/v1/jobs/$job" "/v1/jobs/$job/artifacts" \
  "/v1/jobs/$job/artifacts/result.json" "/v1/jobs/$job/events"; do
  expect "another tenant at $path" "$(status "${bob[@]}" "$url$path")" 404
done
expect "another tenant cancels" "$(status "${bob[@]}" -X DELETE "$url/v1/jobs/$job")" 404
expect "another tenant deletes" "$(status "${bob[@]}" -X DELETE "$url/v1/bodies/$body")" 404
expect "another tenant uses" "$(submit write '{}' "${bob[@]}" -o /dev/null -w '%{http_code}')" 422
expect "another tenant's list" "$(get /v1/bodies "${bob[@]}" | field '.items | length')" 0
# The same bytes are each tenant's own.
mine=$(post /v1/bodies '{"builtin":"tube-14-100"}' "${bob[@]}" | field .id)
[ "$mine" != "$body" ] || fail "two tenants share an id"
! grep -q 'alice-key\|bob-key' "$work/log" || fail "a key stands in the log"
