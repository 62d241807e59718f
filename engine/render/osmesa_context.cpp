// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/osmesa_context.h"

#include <algorithm>

#include <GL/osmesa.h>

#include "engine/core/error.h"

namespace toile {
namespace {

class Context {
 public:
  Context() : handle_(OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr)) {
    if (!handle_) throw Error(ErrorCode::Internal, "picture", "no off-screen rendering context; is OSMesa installed?");
  }
  ~Context() { OSMesaDestroyContext(handle_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Later drawing goes to `pixels` (RGBA, 4 * width * height, rows from the top), which must outlive it.
  void bind(std::vector<std::uint8_t>& pixels, int width, int height) {
    if (!OSMesaMakeCurrent(handle_, pixels.data(), GL_UNSIGNED_BYTE, width, height))
      throw Error(ErrorCode::Internal, "picture", "the off-screen rendering context refused its buffer");
    OSMesaPixelStore(OSMESA_Y_UP, 0);
  }

 private:
  OSMesaContext handle_;
};

Context& context_of_this_thread() {
  thread_local Context context;
  return context;
}

void draw(GLenum kind, const std::vector<float>& positions, const std::vector<std::uint8_t>& colours) {
  if (positions.empty()) return;
  glVertexPointer(3, GL_FLOAT, 0, positions.data());
  glColorPointer(3, GL_UNSIGNED_BYTE, 0, colours.data());
  glDrawArrays(kind, 0, static_cast<GLsizei>(positions.size() / 3));
}

void draw_batch(const RasterBatch& batch, int width, int height, Rgb background) {
  glViewport(0, 0, width, height);
  glClearColor(background.r / 255.0f, background.g / 255.0f, background.b / 255.0f, 1.0f);
  glClearDepth(1.0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_DITHER);
  // Normalised device z grows away from the viewer; the batch's grows towards.
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glScalef(1.0f, 1.0f, -1.0f);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  draw(GL_TRIANGLES, batch.triangle_positions, batch.triangle_colours);
  glLineWidth(static_cast<GLfloat>(batch.line_width));
  draw(GL_LINES, batch.line_positions, batch.line_colours);
  glFinish();
}

Image without_alpha(const std::vector<std::uint8_t>& rgba, int width, int height) {
  Image image(width, height, {});
  for (std::size_t i = 0, o = 0; o < image.rgb.size(); i += 4, o += 3) {
    image.rgb[o] = rgba[i];
    image.rgb[o + 1] = rgba[i + 1];
    image.rgb[o + 2] = rgba[i + 2];
  }
  return image;
}

}  // namespace

Image rasterise(const RasterBatch& batch, int width, int height, Rgb background) {
  constexpr int kLongestSide = 8192;
  if (width < 1 || height < 1 || width > kLongestSide || height > kLongestSide)
    throw Error(ErrorCode::LimitExceeded, "picture", "a view of more than 8192 pixels a side cannot be made");
  std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  context_of_this_thread().bind(pixels, width, height);
  draw_batch(batch, width, height, background);
  return without_alpha(pixels, width, height);
}

}  // namespace toile
