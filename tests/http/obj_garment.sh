#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A garment as a 3D file: its fields reach the job, which gives the same bytes as the command line with the same flags.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE" --workers 1

form=builtin:tube-14-100
"$TOILE" --quiet drape --garment "$source_root/schemas/examples/tube_skirt.json" --body $form --outputs drape.obj \
  --out "$work/made" > /dev/null
body=$(post /v1/bodies '{"builtin":"tube-14-100"}' | jq -r .id)

upload() { # upload CURL ARGUMENT...: the garment's id
  curl -sS -F file=@"$work/made/drape.obj" "$@" "$url/v1/garments" | jq -r .id
}
same_as() { # same_as GARMENT REST FLAG...: a drape of it, byte by byte as the command line's
  local garment=$1 rest=$2 job
  shift 2
  job=$(post /v1/jobs "{\"kind\":\"drape\",\"garment\":\"$garment\",\"reference_body\":\"$body\"}" -H 'Prefer: wait=60')
  expect "the drape" "$(echo "$job" | jq -r .state)" succeeded
  "$TOILE" --quiet drape --garment "$work/made/drape.obj" --body $form "$@" --out "$work/command" > /dev/null
  for name in drape.obj fit.png result.json; do
    get "/v1/jobs/$(echo "$job" | jq -r .id)/artifacts/$name" > "$work/served"
    cmp "$work/served" "$work/command/$name" || fail "$name differs between the command and the server ($*)"
  done
  expect "how it rests ($*)" "$(jq -r .quality.rest "$work/command/result.json")" "$rest"
}

printf '{"schema":"toile/seams/1","seams":[],"panels":{"front":{"label":"body"}}}' > "$work/seams.json"
same_as "$(upload)" converged
same_as "$(upload -F keep_drape=true)" as_given --keep-drape
same_as "$(upload -F uv_unit=cm -F seams="<$work/seams.json")" converged --uv-unit cm --seams "$work/seams.json"

sed -i s/front/skirt/ "$work/seams.json"
curl -sS -F file=@"$work/made/drape.obj" -F seams="<$work/seams.json" "$url/v1/garments" > "$work/refused"
expect "seams for a panel that is not there" "$(jq -r .code "$work/refused")" file_malformed
