# SPDX-License-Identifier: GPL-3.0-or-later
"""hostile.py PORT SERVER_PROCESS JOB: attacks the server on PORT; ends with 1 when an answer or its memory is wrong."""
import gzip
import socket
import sys
import threading
import time

port, process, job = int(sys.argv[1]), sys.argv[2], sys.argv[3]
wrong = []


def connect():
    return socket.create_connection(("127.0.0.1", port), timeout=30)


def answer_of(sock):
    data = b""
    try:
        while b"\r\n" not in data:
            piece = sock.recv(4096)
            if not piece:
                break
            data += piece
    except OSError:
        pass
    return int(data.split(b" ")[1]) if data.startswith(b"HTTP/1.") else 0


def send(pieces):
    """Sends until the server stops reading; answers the status."""
    with connect() as sock:
        try:
            for piece in pieces:
                sock.sendall(piece)
        except OSError:
            pass
        return answer_of(sock)


def expect(what, found, wanted):
    good = found in wanted
    print(("ok    " if good else "WRONG ") + what, found, flush=True)
    if not good:
        wrong.append(what)


def head(lines, method="POST", path="/v1/bodies"):
    return "\r\n".join(["%s %s HTTP/1.1" % (method, path), "Host: x"] + lines + ["", ""]).encode()


def peak_memory_mb():
    for line in open("/proc/%s/status" % process):
        if line.startswith("VmHWM"):
            return int(line.split()[1]) / 1024


megabyte = b"x" * (1 << 20)
chunk = b"100000\r\n" + megabyte + b"\r\n"
multipart = "Content-Type: multipart/form-data; boundary=b"

expect("200 MB in chunks", send([head(["Transfer-Encoding: chunked"])] + [chunk] * 200), [411])
bomb = gzip.compress(b"\0" * (50 << 20))
expect("gzip bomb", send([head(["Content-Encoding: gzip", "Content-Length: %d" % len(bomb)]), bomb]), [415])
expect("200000 headers", send([head(["X-H%d: 1" % i for i in range(200000)])]), [431])
expect("endless header line", send([b"GET / HTTP/1.1\r\nX: "] + [megabyte] * 64), [431])
expect("endless request line", send([b"GET /"] + [megabyte] * 16), [431])
ranges = "Range: bytes=" + ",".join("0-" for _ in range(100))
expect("100 overlapping ranges", send([head([ranges], "GET", "/v1/jobs/%s/artifacts/filler.bin" % job)]), [416])
for bad in ("abc", "-5", "1e9", "99999999999999999999", "", "5, 5", "+5"):
    expect("Content-Length: " + bad, send([head(["Content-Length: " + bad])]), [400])
expect("two lengths", send([head(["Content-Length: 5", "Content-Length: 6"])]), [400])
expect("too large", send([head([multipart, "Content-Length: 1000000000"]), megabyte]), [413])
expect("a header with a line break inside", send([b"GET / HTTP/1.1\r\nA: b\r\n c: d\r\n\r\n"]), [400])
expect("a zero byte in the header", send([b"GET /\0 HTTP/1.1\r\n\r\n"]), [400])
expect("another protocol", send([b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\r\n\r\n"]), [400])
expect("an old version", send([b"GET / HTTP/3.7\r\n\r\n"]), [505])
expect("path traversal", send([head([], "GET", "/v1/jobs/../../../etc/passwd")]), [404])
expect("a multipart without end", send([head([multipart, "Content-Length: 9"]), b"--b\r\n\r\n\r\n"]), [400])
smuggled = head(["Content-Length: 40"], "GET", "/healthz") + b"GET /v1/jobs HTTP/1.1\r\nHost: x\r\n\r\n" + b" " * 6
with connect() as sock:
    sock.sendall(smuggled)
    everything = sock.recv(65536)
    sock.settimeout(3)  # for an answer too many
    try:
        while piece := sock.recv(65536):
            everything += piece
    except OSError:
        pass
    expect("answers to a request hidden in a body", everything.count(b"HTTP/1.1 "), [1])

def honest(times):
    for _ in range(100):
        start = time.monotonic()
        status = send([head(["Connection: close"], "GET", "/v1/jobs/" + job)])
        times.append(time.monotonic() - start if status == 200 else 99.0)


def honest_clients(beside):
    """The 99th percentile of the answer times of four clients at once, in seconds."""
    times = []
    threads = [threading.Thread(target=honest, args=(times,)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    times.sort()
    p99 = times[len(times) * 99 // 100]
    print("honest clients %s: median %.1f ms, p99 %.1f ms" % (beside, times[len(times) // 2] * 1e3, p99 * 1e3))
    return p99


# 64 sockets that never finish: half without, half within their body; honest clients must not notice.
alone = honest_clients("alone")
held = []
for i in range(64):
    sock = connect()
    sock.sendall(b"GET /healthz HTTP/1.1\r\nX" if i % 2 else head([multipart, "Content-Length: 1000000"]) + b"--b\r\n")
    held.append(sock)
# A machine busy with other work answers late with and without them.
expect("p99 under a second", honest_clients("beside 64 silent sockets") < max(1.0, 10 * alone), [True])
for sock in held:
    sock.close()
memory = peak_memory_mb()
print("peak memory of the server: %.0f MB" % memory)
expect("memory under 256 MB", memory < 256, [True])
sys.exit(1 if wrong else 0)
