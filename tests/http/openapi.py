# SPDX-License-Identifier: GPL-3.0-or-later
"""openapi.py URL TOILE SOURCE WORK: makes every call of /openapi.yaml and holds the answers against it."""
import json
import subprocess
import sys
import urllib.error
import urllib.request

import yaml

url, toile, source, work = sys.argv[1:5]
wrong, called, seen = [], set(), set()


def request(method, path, body=None, headers=None):
    if isinstance(body, (dict, list)):
        body = json.dumps(body).encode()
        headers = {"Content-Type": "application/json", **(headers or {})}
    made = urllib.request.Request(url + path, data=body, method=method, headers=headers or {})
    try:
        with urllib.request.urlopen(made, timeout=120) as answer:
            return answer.status, answer.headers, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, error.headers, error.read()


document = yaml.safe_load(request("GET", "/openapi.yaml")[2])


def resolved(node):
    while "$ref" in node and node["$ref"].startswith("#/"):
        target = document
        for step in node["$ref"][2:].split("/"):
            target = target[step]
        node = target
    return node


def valid(schema, text, what):
    if "$ref" not in schema:
        return
    name = schema["$ref"].rsplit("/", 1)[1].removesuffix(".schema.json")
    served = request("GET", "/schemas/" + name + ".schema.json")
    if served[0] != 200 or served[2] != open("%s/schemas/%s.schema.json" % (source, name), "rb").read():
        wrong.append("%s: its schema %s is not served as it stands" % (what, name))
    open(work + "/document", "wb").write(text)
    check = subprocess.run([toile, "check", "--schema", name, work + "/document"], capture_output=True, text=True)
    if check.returncode != 0:
        wrong.append("%s: %s" % (what, check.stderr.strip()))


def call(operation, path_values=None, query="", body=None, headers=None, want=None):
    for path, item in document["paths"].items():
        for method, described in item.items():
            if method != "parameters" and described["operationId"] == operation:
                concrete = path
                for name, value in (path_values or {}).items():
                    concrete = concrete.replace("{%s}" % name, value)
                status, got, text = request(method.upper(), concrete + query, body, headers)
                what = "%s %s -> %d" % (method.upper(), concrete + query, status)
                called.add(operation)
                seen.add((operation, status))
                if want and status != want:
                    wrong.append("%s, wanted %d: %s" % (what, want, text[:300]))
                answer = described["responses"].get(str(status))
                if answer is None:
                    wrong.append(what + " is not documented")
                    return text
                answer = resolved(answer)
                media = (got.get("Content-Type") or "").split(";")[0]
                content = answer.get("content")
                if content and text:
                    if media in content:
                        valid(content[media]["schema"], text, what)
                    elif "*/*" not in content:
                        wrong.append("%s: content type %s is not documented" % (what, media))
                return text
    raise SystemExit("no operation " + operation)


def made(text):
    return json.loads(text)["id"]


skirt = json.load(open(source + "/schemas/examples/tube_skirt.json"))
reference = made(call("createBody", body={"builtin": "tube-14-100", "labels": ["form"]}, want=201))
call("createBody", body={"builtin": "tube-14-100"}, want=200)
target = made(call("createBody", body={"builtin": "tube-18-100", "labels": ["form"]}, want=201))
call("createBody", body={"colour": "red"}, want=422)
call("createBody", body=b"{", headers={"Content-Type": "application/json"}, want=400)
call("createBody", body=b"x", headers={"Content-Type": "image/png"}, want=415)
call("listBodies", query="?label=form&limit=1", want=200)
call("listBodies", query="?limit=x", want=422)
call("getBody", {"id": reference}, want=200)
call("getBody", {"id": "body_0"}, want=404)
garment = made(call("createGarment", body={"specification": skirt, "name": "tube skirt"}, want=201))
call("listGarments", want=200)
call("getGarment", {"id": garment}, want=200)
boundary = b"--b\r\nContent-Disposition: form-data; name=\"file\"; filename=\"s.json\"\r\n\r\n"
upload = boundary + json.dumps(skirt).encode() + b"\r\n--b--\r\n"
other = made(call("createGarment", body=upload, headers={"Content-Type": "multipart/form-data; boundary=b"}, want=201))
job_text = {"kind": "write", "garment": garment, "reference_body": reference, "target_body": target, "labels": ["one"]}
job = made(call("createJob", body=job_text, headers={"Prefer": "wait=60", "Idempotency-Key": "k"}, want=200))
call("createJob", body={**job_text, "kind": "sleep"}, want=202)
call("createJob", body={**job_text, "kind": "no"}, want=422)
call("createJob", body={**job_text, "labels": []}, headers={"Idempotency-Key": "k"}, want=422)
failed = made(call("createJob", body={**job_text, "kind": "fail"}, headers={"Prefer": "wait=60"}, want=200))
call("listJobs", query="?state=succeeded&label=one", want=200)
call("getJob", {"id": job}, want=200)
call("getJob", {"id": failed}, want=200)
call("getJob", {"id": "job_0"}, want=404)
call("getJobEvents", {"id": job}, want=200)
call("getJobEvents", {"id": job}, query="?wait=1", want=200)
call("listArtifacts", {"id": job}, want=200)
call("getArtifact", {"id": job, "name": "result.json"}, want=200)
call("getArtifact", {"id": job, "name": "no.json"}, want=404)
for item in json.loads(request("GET", "/v1/jobs/%s/artifacts" % job)[2])["items"]:
    valid({"$ref": "schemas/artifact.schema.json"}, json.dumps(item).encode(), "artifact " + item["name"])
slow = made(call("createJob", body={**job_text, "kind": "sleep", "options": {"ms": 60000}}, want=202))
call("cancelJob", {"id": slow}, want=200)
call("cancelJob", {"id": "job_0"}, want=404)
batch = made(call("createBatch", body={"garment": garment, "reference_body": reference, "target_bodies": [target],
                                       "options": {"triangles": 500}}, want=202))
call("createBatch", body={"garment": garment, "reference_body": reference}, want=422)
call("createBatch", body=b"{", headers={"Content-Type": "application/json"}, want=400)
call("createBatch", body=b"x", headers={"Content-Type": "image/png"}, want=415)
call("listBatches", want=200)
call("listBatches", query="?label=spring", want=422)
call("getBatch", {"id": batch}, want=200)
call("getBatch", {"id": "batch_0"}, want=404)
for operation in ("getBatchTable", "getBatchPage"):
    call(operation, {"id": batch}, want=200)
    call(operation, {"id": "batch_0"}, want=404)
for operation in ("health", "ready", "metrics", "version", "openapi"):
    call(operation, want=200)
call("schema", {"file": "job.schema.json"}, want=200)
call("schema", {"file": "../openapi.yaml"}, want=404)
call("deleteGarment", {"id": other}, want=204)
call("deleteBody", {"id": target}, want=204)
call("deleteBody", {"id": target}, want=404)
call("getJob", {"id": job}, want=404)

documented = {described["operationId"] for item in document["paths"].values()
              for method, described in item.items() if method != "parameters"}
for operation in sorted(documented - called):
    wrong.append("documented but not called: " + operation)
print("%d operations, %d answers" % (len(called), len(seen)))
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
