#include "ui/picture.h"

#include <glad/gl.h>

#include <cmath>
#include <string>

#include "core/error.h"

namespace lightbench::ui {
namespace {

constexpr const char* kVertexShader = R"(#version 330 core
void main() {  // one triangle that covers the framebuffer
  vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
})";

// The formulas of core/film/tone_map.cpp, in the same order; a test compares the two.
constexpr const char* kFragmentShader = R"(#version 330 core
uniform sampler2D radiance;
uniform float gain;
uniform int tone_map;  // 0 srgb, 1 reinhard, 2 aces
out vec4 color;

float curve(float x) {
  if (tone_map == 1) return x / (1.0 + x);
  if (tone_map == 2) return min(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14));
  return min(x, 1.0);
}
float srgb(float x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}
float display_value(float x) {
  x *= gain;
  x = x > 0.0 ? min(x, 1e6) : 0.0;
  return clamp(srgb(curve(x)), 0.0, 1.0);
}
void main() {
  vec3 x = texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb;
  color = vec4(display_value(x.r), display_value(x.g), display_value(x.b), 1.0);
})";

GLuint compile_stage(GLenum stage, const char* source) {
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    std::string log(1024, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw Error(ErrorKind::Internal, "the display shader does not compile: " + log);
  }
  return shader;
}

GLuint link_program() {
  const GLuint program = glCreateProgram();
  const GLuint vertex = compile_stage(GL_VERTEX_SHADER, kVertexShader);
  const GLuint fragment = compile_stage(GL_FRAGMENT_SHADER, kFragmentShader);
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glLinkProgram(program);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) throw Error(ErrorKind::Internal, "the display shader does not link");
  return program;
}

void set_filter(GLint minify, GLint magnify) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minify);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnify);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

Picture::Picture() {
  program_ = link_program();
  exposure_location_ = glGetUniformLocation(program_, "gain");
  tone_map_location_ = glGetUniformLocation(program_, "tone_map");
  glGenVertexArrays(1, &vertex_array_);
  glGenFramebuffers(1, &framebuffer_);
  glGenTextures(1, &linear_texture_);
  glGenTextures(1, &display_texture_);
  glBindTexture(GL_TEXTURE_2D, linear_texture_);
  set_filter(GL_NEAREST, GL_NEAREST);
  glBindTexture(GL_TEXTURE_2D, display_texture_);
  set_filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
}

Picture::~Picture() {
  glDeleteTextures(1, &linear_texture_);
  glDeleteTextures(1, &display_texture_);
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteVertexArrays(1, &vertex_array_);
  glDeleteProgram(program_);
}

void Picture::upload(const Image& image) {
  if (image.width <= 0 || image.height <= 0) return;
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glBindTexture(GL_TEXTURE_2D, linear_texture_);
  if (image.width == width_ && image.height == height_) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGB, GL_FLOAT, image.rgb.data());
  } else {
    width_ = image.width;
    height_ = image.height;
    developed_ = false;
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, width_, height_, 0, GL_RGB, GL_FLOAT,
                 image.rgb.data());
    glBindTexture(GL_TEXTURE_2D, display_texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 nullptr);
  }
  stale_ = true;
}

void Picture::develop(const Display& display) {
  if (width_ == 0 || (developed_ && !stale_ && display == shown_)) return;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, display_texture_, 0);
  glViewport(0, 0, width_, height_);
  for (const auto state : {GL_BLEND, GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_CULL_FACE}) {
    glDisable(static_cast<GLenum>(state));
  }
  glUseProgram(program_);
  glUniform1f(exposure_location_, static_cast<float>(std::exp2(display.exposure)));
  glUniform1i(tone_map_location_, static_cast<int>(display.tone_map));
  glActiveTexture(GL_TEXTURE0);
  glBindSampler(0, 0);
  glBindTexture(GL_TEXTURE_2D, linear_texture_);
  glBindVertexArray(vertex_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glBindTexture(GL_TEXTURE_2D, display_texture_);
  glGenerateMipmap(GL_TEXTURE_2D);
  developed_ = true;
  stale_ = false;
  shown_ = display;
}

std::vector<std::uint8_t> Picture::read_rgb() const {
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(width_) *
                                static_cast<std::size_t>(height_) * 3);
  if (!developed_) return rgb;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glBindTexture(GL_TEXTURE_2D, display_texture_);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
  return rgb;
}

}  // namespace lightbench::ui
