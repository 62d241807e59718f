# SPDX-License-Identifier: GPL-3.0-or-later
# What the scripts share: a server of their own on a free loopback port, cleaned up however they end.
# Time limits only end what hangs: they are many times what a loaded machine needs, and no script relies on being quick.
# TOILE: the program; TOILE_TESTING: the same with job kinds that crash on purpose (ctest sets both).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_root=$(cd "$here/../.." && pwd)
: "${TOILE:=$source_root/build/bin/toile}"
: "${TOILE_TESTING:=$source_root/build/bin/toile-testing}"
export TOILE TOILE_TESTING
work=$(mktemp -d)
data=$work/data
server=
others=()

finish() {
  local status=$?
  for process in "$server" "${others[@]}"; do
    [ -z "$process" ] || kill -KILL "$process" 2> /dev/null || true
  done
  wait 2> /dev/null || true
  if [ "$status" -ne 0 ] && [ -f "$work/log" ]; then
    echo "--- the server's last lines:" >&2
    tail -n 4 "$work/log" >&2
  fi
  rm -rf "$work"
  exit "$status"
}
trap finish EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
expect() { # expect WHAT FOUND WANTED
  [ "$2" = "$3" ] || fail "$1: found '$2', wanted '$3'"
}

# start_server PROGRAM [FLAG...]: sets $server and $url.
start_server() {
  local program=$1
  shift
  rm -f "$work/port"
  "$program" serve --data "$data" --port 0 --port-file "$work/port" "$@" 2>> "$work/log" &
  server=$!
  for _ in $(seq 1200); do
    [ -s "$work/port" ] && break
    kill -0 "$server" 2> /dev/null || fail "the server did not start"
    sleep 0.1
  done
  [ -s "$work/port" ] || fail "the server does not listen"
  url=http://127.0.0.1:$(cat "$work/port")
}
stop_server() { # SIGTERM; the exit code in $stopped
  kill -TERM "$server"
  stopped=0
  wait "$server" || stopped=$?
  server=
}

json=(-H "Content-Type: application/json")
post() { # post PATH JSON [CURL ARGUMENT...]
  local path=$1 body=$2
  shift 2
  curl -sS --max-time 280 -X POST "${json[@]}" -d "$body" "$@" "$url$path"
}
get() {
  local path=$1
  shift
  curl -sS --max-time 280 "$@" "$url$path"
}
status() { # status CURL ARGUMENT...: the HTTP status alone
  curl -sS --max-time 280 -o /dev/null -w '%{http_code}' "$@"
}
field() { jq -r "$1"; }

# Inputs for jobs that do not read them as a tailor would.
test_inputs() {
  body=$(post /v1/bodies '{"builtin":"tube-14-100"}' "$@" | field .id)
  target=$(post /v1/bodies '{"builtin":"tube-18-100"}' "$@" | field .id)
  garment=$(curl -sS "$@" -F file=@"$source_root/schemas/examples/tube_skirt.json" "$url/v1/garments" | field .id)
}
job_text() { # job_text KIND OPTIONS
  printf '{"kind":"%s","garment":"%s","reference_body":"%s","target_body":"%s","options":%s}' \
    "$1" "$garment" "$body" "$target" "$2"
}
submit() { # submit KIND OPTIONS [CURL ARGUMENT...]
  local text
  text=$(job_text "$1" "$2")
  shift 2
  post /v1/jobs "$text" "$@"
}
wait_for_state() { # wait_for_state JOB STATE
  local found
  for _ in $(seq 2000); do
    found=$(get "/v1/jobs/$1" | field .state)
    [ "$found" = "$2" ] && return 0
    case $found in succeeded | failed | cancelled) break ;; esac
    sleep 0.1
  done
  fail "job $1 is $found, not $2"
}
