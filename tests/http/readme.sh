#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the README files show works as it stands: the blocks from garment to report, each curl line of the table of calls,
# the lines that make a key and check a webhook.
. "$(dirname "$0")/lib.sh"
start_server "$TOILE" --workers 1
cd "$work"
ln -s "$source_root/schemas" schemas

# Indented lines of a page between a line that holds FIRST and the next heading, without commands of the program itself.
block() { awk -v first="$2" 'index($0, first) { on = 1; next } on && /^## / { exit } on && /^    / { print substr($0, 5) }' "$1" |
  grep -v '^\(build/bin/\)\?toile '; }
# Runs shown lines: at the test's server, and every refusal ends the run.
run() {
  { echo 'curl() { command curl --fail-with-body -sS --max-time 280 "$@"; }'; sed "s|http://127.0.0.1:8080|$url|"; cat "${2:-/dev/null}"; } \
    < "$1" > "$1.run"
  bash -euo pipefail "$1.run" > "$1.said" || fail "$1: $(tail -n 3 "$1.said")"
}

block "$source_root/README.md" '## Over HTTP' > first
run first
expect "the end of the job" "$(tail -n 1 first.said)" "event: succeeded"
grep -q '</html>' report.html || fail "no report"

# The same with scans.
page=$source_root/server/README.md
cp schemas/examples/a_line_skirt.json skirt.json
"$TOILE" --quiet body builtin:woman-38-168 --out fits.obj > /dev/null
"$TOILE" --quiet body --measurements <(echo '{"figure":"woman","measurements_cm":{"height":166,"bust_girth":88,"waist_girth":71,"hip_girth":97}}') \
  --out customer.obj > /dev/null
/usr/bin/python3 - << 'PY'
rows = [line.split() for line in open("customer.obj")]
vertices = [row[1:4] for row in rows if row[:1] == ["v"]]
faces = [[int(corner.split("/")[0]) - 1 for corner in row[1:4]] for row in rows if row[:1] == ["f"]]
with open("customer.ply", "w") as out:
    out.write("ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n" % len(vertices))
    out.write("element face %d\nproperty list uchar int vertex_indices\nend_header\n" % len(faces))
    out.writelines(" ".join(vertex) + "\n" for vertex in vertices)
    out.writelines("3 %d %d %d\n" % tuple(face) for face in faces)
with open("b.obj", "w") as out:  # in centimetres, as the line that sends it says
    out.writelines("v %f %f %f\n" % tuple(100 * float(x) for x in vertex) for vertex in vertices)
    out.writelines("f %d %d %d\n" % tuple(corner + 1 for corner in face) for face in faces)
PY
block "$page" '## From a scan' > second
echo 'declare -p garment reference target job > ids' > tail
run second tail
grep -q '^event: succeeded' second.said || fail "the job on scans: $(tail -n 3 second.said)"
grep -q '</html>' ticket.html || fail "no ticket"

# The table of calls: its own body, which one line deletes; the job and the labelled body of the block above.
. ./ids
cp skirt.json g.json
echo "{\"garment\":\"$garment\",\"reference_body\":\"$reference\",\"target_body\":\"$target\",\"options\":{\"triangles\":1000}}" > job.json
echo "{\"garment\":\"$garment\",\"reference_body\":\"$reference\",\"label\":\"spring\",\"options\":{\"triangles\":1000}}" > batch.json
post /v1/batches "$(cat batch.json)" > batch
body=$(curl -sSF file=@b.obj -F labels=a "$url/v1/bodies" | field .id)
{
  echo "U=$url body=$body job=$job batch=$(field .id < batch)"
  awk '/^## Endpoints/ { on = 1; next } /^## / { on = 0 } on && /^\|/' "$page" | grep -o '`curl [^`]*`' | tr -d '`'
} > third
[ "$(wc -l < third)" -gt 15 ] || fail "the table has only $(wc -l < third) lines"
run third

# A key and a signature.
block "$page" '## Endpoints' | sed -n '/^key=/p' > fourth
run fourth
expect "the hash of the key" "$(printf %s "$(cat fourth.said)" | sha256sum | cut -d' ' -f1)" "$(cut -d' ' -f2 keys)"
{ echo "secret=s id=i timestamp=1 body=b"; block "$page" '## Endpoints' | grep openssl | grep -v '^key='; } > fifth
run fifth
expect "the signature" "$(cat fifth.said)" "$(/usr/bin/python3 -c '
import base64, hashlib, hmac
print(base64.b64encode(hmac.new(b"s", b"i.1.b", hashlib.sha256).digest()).decode())')"
