// lightbench query: rays, lights and materials of a scene, asked and answered in JSON lines.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>

#include "app/commands.h"
#include "app/line_reader.h"
#include "app/query_fields.h"
#include "app/scene_options.h"
#include "core/error.h"
#include "core/query/lights.h"
#include "core/query/materials.h"
#include "core/query/rays.h"

namespace lightbench {
namespace {

/// Questions collected before they are answered together.
constexpr std::size_t kBatch = 4096;

struct QueryOptions {
  SceneOptions scene;
  std::string input;
  bool any = false;
  bool lights = false;
  bool bsdf = false;
};

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const Named& element : list) names.push_back(element.name);
  return names;
}

/// What every kind of question needs.
struct Subject {
  Scene scene;
  std::shared_ptr<const RenderScene> compiled;
  std::vector<std::string> objects, materials;

  [[nodiscard]] const Object& object(int index) const {
    return scene.objects[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] double time_of(QueryFields& fields) const {
    const double open = scene.camera.shutter_open, close = scene.camera.shutter_close;
    const double time = fields.number("time", open);
    if (!(time >= open && time <= close)) {
      fields.reject("time", fmt::format("a time while the shutter is open, {} to {}", open, close));
    }
    return time;
  }
};

/// Questions of one kind: read() takes a line, answer() returns the lines for those read and
/// forgets them.
class Questions {
 public:
  virtual ~Questions() = default;
  virtual void read(QueryFields& fields) = 0;
  virtual std::string answer() = 0;
};

class RayQuestions : public Questions {
 public:
  RayQuestions(const Subject& subject, bool any) : subject_(subject), any_(any) {}

  void read(QueryFields& fields) override {
    Ray ray;
    ray.origin = fields.point("o");
    ray.direction = fields.direction("d");
    ray.t_min = fields.number("tmin", 0);
    ray.t_max = fields.number("tmax", ray.t_max);
    if (ray.t_min < 0) fields.reject("tmin", "a distance from 0 on");
    ray.time = subject_.time_of(fields);
    if (fields.has("from")) {
      QueryFields from = fields.object("from");
      ray.from.object = from.name("object", subject_.objects, "an object");
      if (const int triangles = triangle_count(ray.from.object)) {
        ray.from.triangle = from.index("triangle", triangles);
      }
      ray.from.inside = from.boolean("inside", false);
      from.expect_no_more();
    } else {
      fields.optional("from");
    }
    fields.expect_no_more();
    rays_.push_back(ray);
  }

  std::string answer() override {
    std::string text;
    if (any_) {
      std::vector<std::uint8_t> blocked(rays_.size());
      occluded(*subject_.compiled, rays_, blocked);
      for (const std::uint8_t b : blocked) text += AnswerLine().add("hit", b != 0).text() + "\n";
    } else {
      std::vector<std::optional<Hit>> hits(rays_.size());
      trace(*subject_.compiled, rays_, hits);
      for (const auto& hit : hits) text += line(hit).text() + "\n";
    }
    rays_.clear();
    return text;
  }

 private:
  /// 0 for objects that are no mesh.
  [[nodiscard]] int triangle_count(int object) const {
    const auto* mesh = std::get_if<MeshShape>(&subject_.object(object).shape);
    if (mesh == nullptr) return 0;
    const Mesh& data = *subject_.scene.meshes[static_cast<std::size_t>(mesh->mesh)].data;
    return static_cast<int>(data.triangles.size());
  }

  [[nodiscard]] AnswerLine line(const std::optional<Hit>& hit) const {
    AnswerLine answer;
    answer.add("hit", hit.has_value());
    if (!hit) return answer;
    answer.add("t", hit->t).add("p", hit->position).add("ng", hit->geometric_normal);
    answer.add("ns", hit->shading_normal).add("uv", hit->u, hit->v).add("front", hit->front);
    const Object& object = subject_.object(hit->object);
    answer.add("object", object.name);
    answer.add("material", subject_.materials[static_cast<std::size_t>(object.material)]);
    if (hit->triangle != kNone) answer.add("triangle", hit->triangle);
    return answer;
  }

  const Subject& subject_;
  bool any_;
  std::vector<Ray> rays_;
};

class LightQuestions : public Questions {
 public:
  explicit LightQuestions(const Subject& subject)
      : subject_(subject), count_(light_count(*subject.compiled)) {}

  void read(QueryFields& fields) override {
    Question q;
    const glm::dvec3 point = fields.point("p");
    q.has_normal = fields.has("n");
    q.normal = glm::normalize(fields.direction("n", {0, 0, 1}));
    const glm::dvec3 chooser = q.has_normal ? q.normal : glm::dvec3(0);
    q.directed = fields.has("d");
    const glm::dvec3 direction = fields.direction("d", {0, 0, 1});
    const double time = subject_.time_of(fields);
    int first = 0, last = count_;
    if (fields.has("light")) {
      first = fields.index("light", count_);
      last = first + 1;
    }
    fields.optional("light");
    std::vector<double> u;
    if (!q.directed) u = fields.units("u", 2, 2);
    fields.optional("u");
    const bool chosen = fields.has("choice");
    const double choice = fields.unit("choice", 0);
    fields.expect_no_more();

    q.first = q.directed ? directions_.size() : samples_.size();
    if (!q.directed && chosen && count_ > 0) {
      samples_.push_back({point, u[0], u[1], choice, kNone, time, chooser});
      last = first;
    }
    for (int i = first; i < last; ++i) {
      if (q.directed) {
        directions_.push_back({point, direction, i, time, chooser});
      } else {
        samples_.push_back({point, u[0], u[1], 0, i, time, chooser});
      }
    }
    q.count = (q.directed ? directions_.size() : samples_.size()) - q.first;
    questions_.push_back(q);
  }

  std::string answer() override {
    std::vector<LightPoint> sampled(samples_.size()), met(directions_.size());
    if (!samples_.empty()) sample_lights(*subject_.compiled, samples_, sampled);
    pdf_lights(*subject_.compiled, directions_, met);
    std::string text;
    for (const Question& q : questions_) {
      std::vector<AnswerLine> lights;
      for (std::size_t i = q.first; i < q.first + q.count; ++i) {
        lights.push_back(q.directed ? line(q, met[i], directions_[i].light)
                                    : line(q, sampled[i], samples_[i].light));
      }
      text += AnswerLine().add("lights", lights).text() + "\n";
    }
    samples_.clear();
    directions_.clear();
    questions_.clear();
    return text;
  }

 private:
  struct Question {
    bool directed, has_normal;
    glm::dvec3 normal;
    std::size_t first, count;  ///< of the samples or of the directions
  };

  [[nodiscard]] AnswerLine line(const Question& q, const LightPoint& point, int asked) const {
    AnswerLine answer;
    answer.add("valid", point.valid);
    const int light = point.valid ? point.light : asked;
    if (light != kNone) {
      const LightSource source = light_source(*subject_.compiled, light);
      answer.add("light", light).add("object", subject_.object(source.object).name);
      if (source.triangle != kNone) answer.add("triangle", source.triangle);
    }
    if (!point.valid) return answer;
    answer.add("selection", point.selection);
    answer.add("d", point.direction).add("distance", point.distance).add("n", point.normal);
    answer.add("pdf", point.pdf).add("radiance", point.radiance);
    if (q.has_normal) answer.add("cosine", glm::dot(point.direction, q.normal));
    return answer;
  }

  const Subject& subject_;
  int count_;
  std::vector<LightQuery> samples_;
  std::vector<LightDirection> directions_;
  std::vector<Question> questions_;
};

class BsdfQuestions : public Questions {
 public:
  explicit BsdfQuestions(const Subject& subject) : subject_(subject) {}

  // In these lines wi is the direction that is known, towards the camera, and wo the one to be
  // found: BsdfQuery names them from the light's side.
  void read(QueryFields& fields) override {
    BsdfQuery query;
    query.material = fields.name("material", subject_.materials, "a material");
    query.normal = fields.direction("n", {0, 0, 1});
    query.wo = fields.direction("wi");
    const bool sample = fields.has("u");
    if (sample) {
      const Material& m = subject_.scene.materials[static_cast<std::size_t>(query.material)];
      const std::vector<double> u = fields.units("u", m.fuzz > 0 ? 3 : 2, 3);
      query.u = u[0];
      query.v = u[1];
      query.w = u.size() > 2 ? u[2] : 0;
      fields.optional("wo");
    } else {
      query.wi = fields.direction("wo");
      fields.optional("u");
    }
    fields.expect_no_more();
    (sample ? samples_ : values_).push_back(query);
    is_sample_.push_back(sample);
  }

  std::string answer() override {
    std::vector<BsdfSample> samples(samples_.size());
    std::vector<BsdfValue> values(values_.size());
    sample_bsdf(*subject_.compiled, samples_, samples);
    eval_bsdf(*subject_.compiled, values_, values);
    std::string text;
    auto sample = samples.begin();
    auto value = values.begin();
    for (const bool is_sample : is_sample_) {
      text += (is_sample ? line(*sample++) : line(*value++)).text() + "\n";
    }
    samples_.clear();
    values_.clear();
    is_sample_.clear();
    return text;
  }

 private:
  static AnswerLine line(const BsdfValue& v) {
    return AnswerLine().add("value", v.value).add("pdf", v.pdf);
  }
  static AnswerLine line(const BsdfSample& s) {
    AnswerLine answer;
    answer.add("valid", s.valid);
    if (!s.valid) return answer;
    answer.add("wo", s.wi).add("weight", s.weight).add("pdf", s.pdf).add("delta", s.delta);
    return answer;
  }

  const Subject& subject_;
  std::vector<BsdfQuery> samples_, values_;
  std::vector<bool> is_sample_;
};

void write(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(ErrorKind::Output, "standard output cannot be written");
  }
}

/// Answers lines in batches, at once when the next line is not there yet.
void answer_all(LineReader& input, Questions& questions) {
  std::string line;
  std::size_t waiting = 0;
  const auto flush = [&] {
    if (waiting > 0) write(questions.answer());
    waiting = 0;
  };
  for (;;) {
    if (waiting == kBatch || input.would_wait()) flush();
    if (!input.next(line)) break;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      QueryFields fields(fmt::format("{} line {}", input.name(), input.line_number()), line);
      questions.read(fields);
    } catch (const Error&) {
      flush();  // what was asked before gets its answer
      throw;
    }
    ++waiting;
  }
  flush();
}

int query(const QueryOptions& options) {
  if ((options.any ? 1 : 0) + (options.lights ? 1 : 0) + (options.bsdf ? 1 : 0) > 1) {
    throw Error(ErrorKind::Usage, "--any, --lights and --bsdf: expected one of them");
  }
  const KernelKind kernel = chosen_kernel(options.scene);
  LineReader input(options.input == "-" ? "" : options.input);
  Subject subject;
  subject.scene = load_scene(options.scene);
  subject.compiled = compile(subject.scene, kernel);
  subject.objects = names_of(subject.scene.objects);
  subject.materials = names_of(subject.scene.materials);
  std::unique_ptr<Questions> questions;
  if (options.lights) {
    questions = std::make_unique<LightQuestions>(subject);
  } else if (options.bsdf) {
    questions = std::make_unique<BsdfQuestions>(subject);
  } else {
    questions = std::make_unique<RayQuestions>(subject, options.any);
  }
  answer_all(input, *questions);
  return 0;
}

}  // namespace

void add_query(CLI::App& app, Action& action) {
  const auto options = std::make_shared<QueryOptions>();
  CLI::App& command = *app.add_subcommand(
      "query",
      "Answer questions about a scene, JSON lines in, JSON lines out: rays, or with a "
      "flag lights or materials");
  add_scene_options(command, options->scene, SceneArgument::Required);
  command.add_option("-i,--input", options->input, "Read from this file, not standard input")
      ->type_name("FILE");
  command.add_flag("--any", options->any, "Only say whether anything is in the ray's way");
  command.add_flag("--lights", options->lights, "Sample the lights from points");
  command.add_flag("--bsdf", options->bsdf, "Evaluate and sample materials");
  command.callback([options, &action] { action = [options] { return query(*options); }; });
}

}  // namespace lightbench
