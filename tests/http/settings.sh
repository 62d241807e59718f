#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Settings: flags win over variables, these over the --config file; what is wrong in it is told by its line. Two servers
# do not share a port.
. "$(dirname "$0")/lib.sh"
printf '# a comment\n\nmax-upload-mb = 1\nport=1\nworkers = 0\nmax-wait-s=7\ndemo = true\n' > "$work/config"
export TOILE_CONFIG=$work/config TOILE_WORKERS=3 TOILE_MAX_WAIT_S=5
start_server "$TOILE_TESTING" --max-wait-s 1 > "$work/said"  # and a port of its own
head -c 1200000 /dev/zero > "$work/large.obj"
expect "a setting of the file" "$(status -F file=@"$work/large.obj" "$url/v1/bodies")" 413
grep -q '^job=' "$work/said" || fail "no demo"
test_inputs
expect "a setting of a flag, a variable and the file" \
  "$(submit sleep '{"ms":60000}' -H 'Prefer: wait=60' -o /dev/null -D - | tr -d '\r' | sed -n 's/^Preference-Applied: //p')" wait=1
for n in 1 2 3 4; do submit sleep "{\"ms\":6000$n}" > /dev/null; done
for _ in $(seq 600); do [ "$(get '/v1/jobs?state=running' | field '.items | length')" = 3 ] && break; sleep 0.1; done
expect "jobs at a time, of a variable and the file" "$(get '/v1/jobs?state=running' | field '.items | length')" 3

code=0
"$TOILE_TESTING" serve --config "" --data "$work/other" --port "${url##*:}" 2> "$work/errors" || code=$?
expect "a second server on the port" "$code" 2
grep -q 'is another server running' "$work/errors" || fail "$(cat "$work/errors")"

unset TOILE_WORKERS TOILE_MAX_WAIT_S
refused() { # refused LINES WANTED...: of the file
  printf "$1" > "$work/config"
  timeout 60 "$TOILE" work --data "$work/other" 2> "$work/errors" && fail "taken: $1"
  grep -qF "$work/config:$2" "$work/errors" || fail "$1: $(cat "$work/errors")"
}
refused 'workers = 2\nwokers = 2\n' '2: there is no setting "wokers"; did you mean --workers?'
refused 'workers = many\n' '1: --workers'
refused 'workers\n' '1: a setting reads name = value'
refused 'lease-s=3\n#\nlease-s=4\n' '3: "lease-s" stands here a second time'
rm "$work/config"
timeout 60 "$TOILE" work --data "$work/other" 2> "$work/errors" && fail "a file that is not there"
grep -q 'cannot be read' "$work/errors" || fail "$(cat "$work/errors")"
