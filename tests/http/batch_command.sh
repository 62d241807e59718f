#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# toile batch: shared work once, resumable, the same files as single jobs, a table and a page; failures do not stop it.
. "$(dirname "$0")/lib.sh"
printf 'builtin:tube-16-100\n# a comment\nbuiltin:tube-18-100\nno-such-file.obj\n' > "$work/list"
skirt=$source_root/schemas/examples/tube_skirt.json
batch() {
  "$TOILE" --quiet batch --garment "$skirt" --reference-body builtin:tube-14-100 --target-bodies "$work/list" \
    --out "$work/out" > "$work/said" 2> "$work/errors"
}
code=0
batch || code=$?
expect "the exit code with a missing body" "$code" 4
expect "rows of the table" "$(wc -l < "$work/out/summary.csv")" 4
expect "what failed" "$(grep -c ',failed,"\?file_unreadable' "$work/out/summary.csv")" 1
grep -q 'tube-16-100' "$work/out/summary.html" || fail "the page does not show the bodies"

"$TOILE" --quiet alter --garment "$skirt" --reference-body builtin:tube-14-100 --target-body builtin:tube-18-100 \
  --out "$work/single" > /dev/null
for file in "$work"/single/*; do
  name=$(basename "$file")
  [ "$name" = timings.json ] || cmp "$file" "$work/out/tube-18-100/$name" || fail "$name differs from the single job"
done
# The reference was read back for the second body, and a finished batch does nothing again.
[ "$(jq '[.. | objects | select(.reused == true)] | length' "$work/out/tube-18-100/timings.json")" -ge 3 ] || fail "nothing was shared"
before=$(stat -c %Y%s "$work/out/tube-18-100/result.json")
sed -i '/no-such/d' "$work/list"
batch || fail "the batch without the missing body failed: $(cat "$work/errors")"
expect "an untouched result" "$(stat -c %Y%s "$work/out/tube-18-100/result.json")" "$before"
