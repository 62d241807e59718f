// SPDX-License-Identifier: GPL-3.0-or-later
// Routes, keys, the table of statuses, signatures, metrics.
#include <gmock/gmock.h>

#include "engine/core/content_hash.h"
#include "server/http/api_keys.h"
#include "server/http/metrics.h"
#include "server/http/router.h"
#include "server/http/webhook_sender.h"

namespace toile::http {

namespace {

Request request_for(const std::string& method, const std::string& path) {
  Request request;
  request.method = method;
  request.path = path;
  return request;
}

}  // namespace

TEST(Router, FindsTheRouteAndTheValuesOfItsPath) {
  Router router;
  router.add({"GET", "/v1/jobs/{id}", nullptr});
  router.add({"DELETE", "/v1/jobs/{id}", nullptr});
  router.add({"GET", "/v1/jobs/{id}/artifacts/{name}", nullptr});
  Request request = request_for("HEAD", "/v1/jobs/a%20b/artifacts/x.png");
  EXPECT_EQ(router.find(request).pattern, "/v1/jobs/{id}/artifacts/{name}");
  EXPECT_EQ(request.path_value("id"), "a b");
  EXPECT_EQ(request.path_value("name"), "x.png");
  for (const char* path : {"/", "/v1/jobs", "/v1/jobs/x/", "/v1/jobs/x/artifacts", "/v1/jobs/../jobs/x"}) {
    Request lost = request_for("GET", path);
    EXPECT_THROW(router.find(lost), Problem) << path;
  }
  Request wrong = request_for("POST", "/v1/jobs/x");
  try {
    router.find(wrong);
    ADD_FAILURE() << "found";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status, 405);
    EXPECT_EQ(problem.headers.front().second, "GET, HEAD, DELETE");
  }
}

TEST(Router, DecodesQueries) {
  const auto values = parse_query("a=1&b=x+y%2Fz&c&&d=%zz%4");
  EXPECT_EQ(values.at("a"), "1");
  EXPECT_EQ(values.at("b"), "x y/z");
  EXPECT_EQ(values.at("c"), "");
  EXPECT_EQ(values.at("d"), "%zz%4");
}

TEST(ApiKeys, AreKnownByTheirHashOnly) {
  const ApiKeys keys = ApiKeys::parse("# shops\nalice " + sha256_hex("secret") + "\n\n");
  Request request;
  request.headers["Authorization"] = "Bearer secret";
  EXPECT_EQ(keys.tenant(request), "alice");
  request.headers = {{"x-api-key", "secret"}};
  EXPECT_EQ(keys.tenant(request), "alice");
  for (const char* wrong : {"", "Secret", "secret "}) {
    request.headers = {{"X-Api-Key", wrong}};
    EXPECT_THROW(keys.tenant(request), Error) << wrong;
  }
  EXPECT_EQ(ApiKeys().tenant(request), "default");
}

TEST(ApiKeys, RefuseAFileThatWouldLetNobodyIn) {
  for (const char* bad : {"", "# nothing", "alice", "alice secret", "alice 0123"})
    EXPECT_THROW(ApiKeys::parse(bad), Error) << bad;
}

TEST(ProblemTable, EveryCodeHasAStatusThatIsARefusal) {
  for (int i = 0; i <= static_cast<int>(ErrorCode::Internal); ++i) {
    const Error error(static_cast<ErrorCode>(i), "/part", "message");
    const Problem problem = problem_of(error);
    EXPECT_GE(problem.status, 400) << i;
    EXPECT_LE(problem.status, 599) << i;
    EXPECT_EQ(problem.code, error_name(error.code));
    EXPECT_NE(reason_phrase(problem.status), "") << i;
    EXPECT_EQ(problem.errors.empty(), problem.status >= 500) << "what lies inside the server is not the client's part";
  }
  EXPECT_EQ(status_of(ErrorCode::StorageFull), 507);
  EXPECT_EQ(status_of(ErrorCode::QueueFull), 429);
}

TEST(Webhooks, AreSignedAsTheStandardsExampleIs) {
  const std::string key = webhook_key("whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw\n");
  EXPECT_EQ(webhook_signature(key, "msg_p5jXN8AQM9LWM0D4loKWxJek", 1614265330, "{\"test\": 2432232314}"),
            "v1,g0hM9SsE+OTPJTGt/tmIKtSyZlE3uFJELVlNIOLJ1OE=");
  EXPECT_THROW(webhook_key("short"), Error);
}

TEST(Webhooks, GoToPublicHttpAddressesOnly) {
  for (const char* bad :
       {"", "ftp://x/", "http://", "http://user@1.1.1.1/", "http://127.0.0.1/", "http://10.1.2.3:80/", "http://[::1]/",
        "http://169.254.169.254/latest", "http://192.168.1.1", "http://[::ffff:10.0.0.1]/", "http://[fe80::1]/",
        "http://100.64.0.1/", "http://0.0.0.0/", "http://1.1.1.1/\r\nX: y"})
    EXPECT_THROW(check_webhook_url(bad, false), Error) << bad;
  EXPECT_NO_THROW(check_webhook_url("https://1.1.1.1:8443/hook", false));
  EXPECT_NO_THROW(check_webhook_url("http://127.0.0.1:9/hook", true));
}

TEST(Metrics, AreCumulativePrometheusText) {
  Metrics metrics;
  metrics.count_request("GET", "/v1/jobs", 200, 0.003);
  metrics.count_request("GET", "/v1/jobs", 200, 100.0);
  metrics.count_refusal("too_many_headers");
  metrics.count_webhook(true);
  const std::string text = metrics.text();
  for (const char* line :
       {"toile_http_requests_total{method=\"GET\",route=\"/v1/jobs\",status=\"200\"} 2\n",
        "toile_http_request_seconds_bucket{le=\"0.001\"} 0\n", "toile_http_request_seconds_bucket{le=\"0.005\"} 1\n",
        "toile_http_request_seconds_bucket{le=\"+Inf\"} 2\n", "toile_http_request_seconds_count 2\n",
        "toile_http_refusals_total{code=\"too_many_headers\"} 1\n", "toile_webhooks_total{delivered=\"true\"} 1\n"})
    EXPECT_THAT(text, ::testing::HasSubstr(line));
}

}  // namespace toile::http
