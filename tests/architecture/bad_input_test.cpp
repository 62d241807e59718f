// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the real executable on broken files: exit code 3, a message with file, place and mend, little memory, at once.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

constexpr double kMostMemoryMb = 256.0;
constexpr double kMostCpuSeconds = 10.0;  // the bar is 1: a busy machine may be slower, growth out of hand is far above

struct Outcome {
  int exit_code = -1;
  std::string message;
  double memory_mb = 0.0, cpu_seconds = 0.0;
};

class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("toile_bad_input_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    if (access(kProgram, X_OK) != 0) GTEST_SKIP() << "the executable is not built";
  }
  void TearDown() override { fs::remove_all(folder_); }

  Outcome check(const std::string& name, const std::string& contents) const {
    const fs::path file = folder_ / name, log = folder_ / "stderr";
    std::ofstream(file, std::ios::binary) << contents;
    const pid_t child = fork();
    if (child == 0) {
      const int out = open(log.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
      dup2(out, STDOUT_FILENO);
      dup2(out, STDERR_FILENO);
      execl(kProgram, "toile", "--quiet", "check", file.c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    std::ifstream in(log);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, std::string(std::istreambuf_iterator<char>(in), {}),
            static_cast<double>(usage.ru_maxrss) / 1024.0, seconds(usage.ru_utime) + seconds(usage.ru_stime)};
  }

  void expect_refused(const std::string& name, const std::string& contents, const std::string& place) const {
    SCOPED_TRACE(name + ", " + place);
    const Outcome outcome = check(name, contents);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.message;
    EXPECT_NE(outcome.message.find(name), std::string::npos) << outcome.message;
    EXPECT_NE(outcome.message.find(place), std::string::npos) << outcome.message;
    EXPECT_LT(outcome.memory_mb, kMostMemoryMb);
    EXPECT_LT(outcome.cpu_seconds, kMostCpuSeconds);
  }

  static constexpr const char* kProgram = TOILE_BINARY_DIR "/bin/toile";
  fs::path folder_;
};

// Two squares sewn along one edge; `vertices` and `stitches` of panel a can be replaced.
std::string garment(const std::string& vertices, const std::string& stitches) {
  const std::string edges =
      R"("edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}])";
  return R"({"pattern":{"panels":{"a":{"vertices":)" + vertices + "," + edges +
         R"(},"b":{"vertices":[[0,0],[10,0],[10,10],[0,10]],)" + edges + R"(}},"stitches":)" + stitches + "}}";
}

const char* const kSquare = "[[0,0],[10,0],[10,10],[0,10]]";
const char* const kStitch = R"([[{"panel":"a","edge":1},{"panel":"b","edge":3}]])";

TEST_F(BadInput, AWholeGarmentIsValid) {
  const Outcome outcome = check("good.json", garment(kSquare, kStitch));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.message;
}

TEST_F(BadInput, BrokenGarmentsAreRefusedWithFilePlaceAndMend) {
  const std::string good = garment(kSquare, kStitch);
  expect_refused("truncated.json", good.substr(0, good.size() / 2), "line 1");
  expect_refused("nan.json", garment("[[0,0],[10,0],[10,NaN],[0,10]]", kStitch), "line 1");
  expect_refused("infinite.json", garment("[[0,0],[10,0],[10,1e999],[0,10]]", kStitch), "finite");
  expect_refused("stitch.json", garment(kSquare, R"([[{"panel":"a","edge":1},{"panel":"b","edge":7}]])"),
                 "#/pattern/stitches/0/1/edge");
  expect_refused(
      "twice.json",
      garment(kSquare,
              R"([[{"panel":"a","edge":1},{"panel":"b","edge":3}],[{"panel":"a","edge":0},{"panel":"b","edge":3}]])"),
      "#/pattern/stitches/1/1");
  expect_refused("crossing.json", garment("[[0,0],[10,10],[10,0],[0,10]]", kStitch), "#/pattern/panels/a/edges/");
  expect_refused("index.json", garment("[[0,0],[10,0],[10,10]]", kStitch), "#/pattern/panels/a/edges/2/endpoints/1");
  expect_refused("deep.json", std::string(1'000'000, '['), "64");
  expect_refused("wide.json", "[" + std::string(20'000'000, '1').replace(1, 1, ",") + "]", "wide.json");
}

// A regular polygon of `edges` edges, each with the curve given as JSON.
std::string round_panel(int edges, const std::string& curvature) {
  std::string vertices, list;
  for (int i = 0; i < edges; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / edges;
    vertices +=
        (i ? ",[" : "[") + std::to_string(100 * std::cos(angle)) + "," + std::to_string(100 * std::sin(angle)) + "]";
    list += std::string(i ? "," : "") + R"({"endpoints":[)" + std::to_string(i) + "," +
            std::to_string((i + 1) % edges) + R"(],"curvature":)" + curvature + "}";
  }
  return R"({"vertices":[)" + vertices + R"(],"edges":[)" + list + "]}";
}

std::string garment_of(int count, const std::string& panel) {
  std::string panels;
  for (int p = 0; p < count; ++p) panels += (p ? ",\"p" : "\"p") + std::to_string(p) + "\":" + panel;
  return R"({"pattern":{"panels":{)" + panels + "}}}";
}

// A comb of slender teeth side by side, drawn as one polyline that never meets itself.
std::string comb_panel(int points) {
  std::string list;
  for (int i = 0; i < points; ++i)
    list += (i ? ",[" : "[") + std::to_string((i + 1.0) / (points + 1.0)) + (i % 2 ? ",2]" : ",0.1]");
  return R"({"vertices":[[0,0],[1000,0]],"edges":[{"endpoints":[0,1],"curvature":{"type":"polyline","params":[)" +
         list + R"(]}},{"endpoints":[1,0]}]})";
}

TEST_F(BadInput, GarmentsMadeToTakeLongAreRefusedAtOnce) {
  const std::string wild = R"({"type":"cubic","params":[[0.5,9000],[0.4,-9000]]})";
  expect_refused("curves.json", garment_of(30, round_panel(2000, wild)), "the outline of panel");
  expect_refused("comb.json", garment_of(1, comb_panel(90'000)), "too intricate");
  std::string objects = "[{}";
  for (int i = 1; i < 400'000; ++i) objects += R"(,{"a":1})";
  expect_refused("objects.json", objects + "]", "objects.json");
  expect_refused("text.json", R"({"pattern":")" + std::string(60'000'000, 'x') + R"("})", "1 MiB");
}

std::string cube(double size) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(size * (i & 1)) + " " + std::to_string(size * (i >> 1 & 1)) + " " +
            std::to_string(size * (i >> 2)) + "\n";
  for (const char* face : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"})
    text += std::string("f ") + face + "\n";
  return text;
}

TEST_F(BadInput, BrokenBodiesAreRefusedWithFileAndMend) {
  expect_refused("cube.obj", cube(1.7), "cube.obj");
  expect_refused("small.obj", cube(0.06), "small.obj");
  expect_refused("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "empty.obj");
  expect_refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "index.obj");
  expect_refused("nan.obj", "v 0 0 nan\n", "line 1");
  expect_refused(
      "count.ply",
      "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1000000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
      "count.ply");
}

}  // namespace
