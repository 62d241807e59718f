# Sourced by the scripts of this folder: a server of one's own on a free port of this machine, and its end.
set -euo pipefail
toile=${TOILE:?path of the toile executable}
examples=${TOILE_EXAMPLES:?schemas/examples}
work=$(mktemp -d)
server=

stop_server() {
  [ -n "$server" ] && kill -"${1:-TERM}" "$server" 2>/dev/null && wait "$server" 2>/dev/null || true
  server=
}
trap 'stop_server KILL; rm -rf "$work"' EXIT

# Starts a server on the data folder $work/data and sets $url.
start_server() {
  : > "$work/log"
  "$toile" serve --data "$work/data" --port 0 "$@" > "$work/log" 2>&1 &
  server=$!
  for _ in $(seq 200); do
    url=$(jq -r 'select(.event == "listening") | .url' "$work/log" 2>/dev/null | head -1)
    [ -n "$url" ] && return
    kill -0 "$server" 2>/dev/null || break
    sleep 0.05
  done
  cat "$work/log"
  fail "the server did not start"
}

fail() { echo "FAILED: $*" >&2; exit 1; }

# expect WHAT WANTED GOT
expect() { [ "$2" = "$3" ] || fail "$1: wanted '$2', got '$3'"; }

post_json() { curl -sS --fail-with-body -H 'Content-Type: application/json' -d "$2" "$url$1"; }
