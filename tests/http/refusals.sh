#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Each bad request gets its status, its code and, where a part of it is to blame, the pointer to that part.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE_TESTING" --workers 1 --max-upload-mb 1 --max-queued 3 --drain-s 1
test_inputs

refused() { # refused WHAT STATUS CODE POINTER CURL ARGUMENT...
  local what=$1 wanted=$2 code=$3 pointer=$4
  shift 4
  local found
  found=$(curl -sS --max-time 60 -o "$work/answer" -w '%{http_code} %{content_type}' "$@")
  expect "$what" "$found" "$wanted application/problem+json"
  expect "$what, code" "$(field .code < "$work/answer")" "$code"
  [ -z "$pointer" ] || expect "$what, pointer" "$(field '.errors[0].pointer' < "$work/answer")" "$pointer"
  "$TOILE" check --schema problem "$work/answer" > /dev/null || fail "$what: the problem document is not valid"
}
on() { echo "$url$1"; }
jobs=(-X POST "${json[@]}" "$(on /v1/jobs)")

head -c 1100000 /dev/zero | tr '\0' ' ' > "$work/large.json"
refused "an unknown address" 404 not_found "" "$(on /v1/nothing)"
refused "path traversal" 404 not_found "" --path-as-is "$(on /v1/jobs/../../etc/passwd)"
refused "escaped path traversal" 404 not_found "" "$(on /v1/jobs/x/artifacts/..%2f..%2ftoile.db)"
refused "a wrong method" 405 method_not_allowed "" -X DELETE "$(on /v1/jobs)"
refused "an unknown method" 405 method_not_allowed "" -X PUT "$(on /v1/jobs)"
refused "no such job" 404 not_found "" "$(on /v1/jobs/job_0)"
refused "no such body" 404 not_found "" -X DELETE "$(on /v1/bodies/body_0)"
refused "a garment's id as a body" 404 not_found "" "$(on "/v1/bodies/$garment")"
refused "no such artifact" 404 not_found "" "$(on /v1/jobs/job_0/artifacts/x.png)"
refused "no such batch" 404 not_found "" "$(on /v1/batches/batch_0)"
refused "broken JSON" 400 file_malformed "" "${jobs[@]}" -d '{"garment":'
refused "a number beyond all" 400 file_malformed "" "${jobs[@]}" -d '{"garment":1e999}'
refused "deep JSON" 400 file_malformed "" "${jobs[@]}" -d "$(printf '[%.0s' $(seq 100))"
refused "JSON of another type" 422 bad_usage "" "${jobs[@]}" -d '[]'
refused "no JSON at all" 400 file_malformed "" -X POST "${json[@]}" "$(on /v1/jobs)"
refused "a kind of JSON" 415 format_unknown "" -X POST -H 'Content-Type: application/jsonp' -d '{}' "$(on /v1/jobs)"
refused "JSON in capitals that lacks all" 422 bad_usage "" -X POST -H 'Content-Type: APPLICATION/JSON; charset=utf-8' -d '{}' "$(on /v1/jobs)"
refused "not JSON" 415 format_unknown "" -X POST -H 'Content-Type: text/plain' -d 'x' "$(on /v1/jobs)"
refused "a missing garment" 422 bad_usage "" "${jobs[@]}" -d "{\"reference_body\":\"$body\"}"
refused "an unknown member" 422 bad_usage "" "${jobs[@]}" -d "$(job_text write '{}' | sed 's/{/{"extra":1,/')"
refused "an unknown kind" 422 bad_usage /kind "${jobs[@]}" -d "$(job_text knit '{}')"
refused "a body that is not there" 422 bad_usage /target_body "${jobs[@]}" \
  -d "$(job_text write '{}' | sed "s/$target/body_00000000000000000000000000000000/")"
refused "an option out of range" 422 option_invalid /options/triangles "${jobs[@]}" -d "$(job_text alter '{"triangles":3}')"
refused "a file of another job" 422 option_invalid /options/outputs/0 "${jobs[@]}" \
  -d "$(job_text drape '{"outputs":["ticket.json"]}')"
refused "an unknown option" 422 option_invalid "" "${jobs[@]}" -d "$(job_text alter '{"colour":3}')"
refused "a webhook without a secret" 422 option_invalid /webhook "${jobs[@]}" \
  -d "$(job_text write '{}' | sed 's/{/{"webhook":"http:\/\/example.org\/x",/')"
refused "a large document" 413 limit_exceeded "" "${jobs[@]}" --data-binary @"$work/large.json"
refused "a misspelt filter" 422 bad_usage lable "$(on '/v1/bodies?lable=spring')"
refused "a bad limit" 422 bad_usage limit "$(on '/v1/jobs?limit=many')"
refused "a bad state" 422 option_invalid state "$(on '/v1/jobs?state=lost')"
refused "a bad wait" 422 bad_usage wait "$(on "/v1/jobs/$(submit write '{}' -H 'Prefer: wait=60' | field .id)/events?wait=soon")"
refused "an empty batch" 422 bad_usage "" -X POST "${json[@]}" "$(on /v1/batches)" \
  -d "{\"garment\":\"$garment\",\"reference_body\":\"$body\",\"target_bodies\":[]}"
refused "a label nobody carries" 422 bad_usage /label -X POST "${json[@]}" "$(on /v1/batches)" \
  -d "{\"garment\":\"$garment\",\"reference_body\":\"$body\",\"label\":\"none\"}"

echo 'v 0 0 0' > "$work/point.obj"
printf 'ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n' > "$work/huge.ply"
head -c 3000000 /dev/urandom > "$work/large.obj"
bodies=$(on /v1/bodies)
refused "a body without triangles" 422 file_malformed "" -F file=@"$work/point.obj" "$bodies"
cp "$source_root/schemas/examples/tube_skirt.json" "$work/skirt.json"
refused "a garment as a body" 422 file_malformed "" -F file=@"$work/skirt.json" "$bodies"
echo '{"measurements_cm":{"height":170}}' > "$work/tape.json"
expect "tape measures as a file" "$(status -F file=@"$work/tape.json" "$bodies")" 201
refused "a header of 10^9 vertices" 413 limit_exceeded "" -F file=@"$work/huge.ply" "$bodies"
refused "a large upload" 413 limit_exceeded "" -F file=@"$work/large.obj" "$bodies"
refused "an upload without a file" 422 bad_usage file -F name=x "$bodies"
refused "an upload of two files" 422 bad_usage file -F file=@"$work/point.obj" -F file=@"$work/point.obj" "$bodies"
refused "an unknown unit" 422 bad_usage unit -F file=@"$work/point.obj" -F unit=ell "$bodies"
refused "an unknown direction" 422 bad_usage up -F file=@"$work/point.obj" -F up=north "$bodies"
refused "an unknown kind of body" 422 bad_usage kind -F file=@"$work/point.obj" -F kind=cat "$bodies"
refused "an unknown unit of a pattern" 422 bad_usage uv_unit -F file=@"$work/point.obj" -F uv_unit=in "$(on /v1/garments)"
refused "a field that is neither" 422 bad_usage keep_drape -F file=@"$work/point.obj" -F keep_drape=1 "$(on /v1/garments)"
refused "seams that are no document" 422 bad_usage seams -F file=@"$work/point.obj" -F seams=none "$(on /v1/garments)"
refused "an unknown form field" 422 bad_usage colour -F file=@"$work/point.obj" -F colour=red "$bodies"
refused "a broken multipart" 400 malformed_multipart "" -X POST -H 'Content-Type: multipart/form-data; boundary=x' -d 'nothing' "$bodies"
refused "an upload of another type" 415 format_unknown "" -X POST -H 'Content-Type: image/png' -d 'x' "$bodies"

wait_for_state "$(submit sleep '{"ms":600000}' | field .id)" running
for n in 1 2 3; do submit sleep "{\"ms\":60000$n}" > /dev/null; done
refused "a job for a full queue" 429 queue_full "" "${jobs[@]}" -d "$(job_text sleep '{"ms":4}')"
expect "Retry-After" "$(submit sleep '{"ms":5}' -o /dev/null -D - | tr -d '\r' | sed -n 's/^Retry-After: //p')" 10

stop_server
start_server "$TOILE_TESTING" --workers 1 --min-free-mb 16000000
refused "a job when the disk is low" 507 storage_full "" -X POST "${json[@]}" "$(on /v1/jobs)" -d "$(job_text write '{}')"
refused "an upload when the disk is low" 507 storage_full "" -F file=@"$work/point.obj" "$(on /v1/bodies)"
expect "readiness when the disk is low" "$(status "$url/readyz")" 503
