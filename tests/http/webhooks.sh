#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Webhooks: signed as Standard Webhooks say, retried under the same id, not sent to private hosts unless allowed.
. "$(dirname "$0")/lib.sh"
cat > "$work/receiver.py" << 'PY'
import http.server, json, sys
class Handler(http.server.BaseHTTPRequestHandler):
    count = 0
    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"])).decode()
        names = ("webhook-id", "webhook-timestamp", "webhook-signature")
        with open(sys.argv[1] + "/received", "a") as out:
            out.write(json.dumps([self.headers[n] for n in names] + [body]) + "\n")
        Handler.count += 1
        self.send_response(500 if Handler.count == 1 else 204)
        self.end_headers()
    def log_message(self, *args): pass
server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
open(sys.argv[1] + "/hook-port", "w").write(str(server.server_port))
server.serve_forever()
PY
/usr/bin/python3 "$work/receiver.py" "$work" &
others+=($!)
for _ in $(seq 600); do [ -s "$work/hook-port" ] && break; sleep 0.1; done
hook=http://127.0.0.1:$(cat "$work/hook-port")/told
printf 'a secret of more than sixteen bytes' > "$work/secret"

start_server "$TOILE_TESTING" --workers 1 --webhook-secret "$work/secret"
test_inputs
with_hook() { job_text write '{}' | sed "s|{|{\"webhook\":\"$1\",|"; }
expect "a private host" "$(post /v1/jobs "$(with_hook "$hook")" -o /dev/null -w '%{http_code}')" 422
expect "not an address" "$(post /v1/jobs "$(with_hook 'file:///etc/passwd')" -o /dev/null -w '%{http_code}')" 422
stop_server

start_server "$TOILE_TESTING" --workers 1 --webhook-secret "$work/secret" --webhook-private
job=$(post /v1/jobs "$(with_hook "$hook")" | field .id)
for _ in $(seq 1200); do [ "$(cat "$work/received" 2> /dev/null | wc -l)" -ge 2 ] && break; sleep 0.1; done
expect "deliveries" "$(wc -l < "$work/received")" 2
expect "message ids" "$(jq -r '.[0]' "$work/received" | sort -u | wc -l)" 1
line=$(tail -1 "$work/received")
expect "what is told" "$(echo "$line" | jq -r '.[3]' | jq -r '.type + " " + .data.id')" "job.succeeded $job"
signed=$(printf '%s.%s.%s' "$(echo "$line" | jq -r '.[0]')" "$(echo "$line" | jq -r '.[1]')" "$(echo "$line" | jq -r '.[3]')" |
  openssl dgst -sha256 -hmac "$(cat "$work/secret")" -binary | base64)
expect "the signature" "$(echo "$line" | jq -r '.[2]')" "v1,$signed"
