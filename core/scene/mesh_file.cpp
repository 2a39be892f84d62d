// Mesh files through assimp.

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/DefaultIOSystem.h>
#include <assimp/IOStream.hpp>
#include <assimp/Importer.hpp>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <unordered_map>

#include "core/error.h"
#include "core/scene/file.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

constexpr std::size_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why) {
  throw Error(ErrorKind::Scene, file.string() + ": cannot be read: " + why);
}

/// Forwards to a stream, and gives up on an importer that reads past the end for ever: assimp's PLY
/// reader does so when a header is cut off.
class GuardedStream : public Assimp::IOStream {
 public:
  explicit GuardedStream(Assimp::IOStream* stream) : stream_(stream) {}

  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    const std::size_t got = stream_->Read(buffer, size, count);
    if (got == 0 && ++empty_reads_ > kMostEmptyReads)
      throw std::runtime_error("the file ends too early");
    return got;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    return stream_->Seek(offset, origin);
  }
  [[nodiscard]] std::size_t Tell() const override { return stream_->Tell(); }
  [[nodiscard]] std::size_t FileSize() const override { return stream_->FileSize(); }
  void Flush() override {}

 private:
  static constexpr int kMostEmptyReads = 1000;
  std::unique_ptr<Assimp::IOStream> stream_;
  int empty_reads_ = 0;
};

class GuardedFiles : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(name, ignored)) return nullptr;
    Assimp::IOStream* stream = DefaultIOSystem::Open(name, mode);
    return stream == nullptr ? nullptr : new GuardedStream(stream);  // Close() deletes it
  }
};

glm::dvec3 to_vector(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// Everything that makes two vertices the same one, by bits.
struct Vertex {
  glm::vec3 position, normal;
  glm::vec2 uv;
  bool operator==(const Vertex&) const = default;
};

struct VertexHash {
  std::size_t operator()(const Vertex& v) const {
    std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a over words, mixed at the end
    for (const float f : {v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y,
                          v.normal.z, v.uv.x, v.uv.y})
      hash = (hash ^ std::bit_cast<std::uint32_t>(f + 0.0F)) * 0x100000001b3U;  // -0 is 0
    return hash ^ (hash >> 29U);
  }
};

/// Adds the triangles of assimp's meshes to one mesh. Vertices are joined when they are equal; the
/// library's own joining merges whatever is within 1e-5, which would eat small models.
class MeshBuilder {
 public:
  MeshBuilder(bool normals, bool uvs) : normals_(normals), uvs_(uvs) {}

  void add(const aiMesh& part) {
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines have no surface
      std::array<std::uint32_t, 3> triangle{};
      for (unsigned corner = 0; corner < 3; ++corner) {
        triangle[corner] = vertex(part, face.mIndices[corner]);
      }
      mesh.triangles.push_back(triangle);
    }
  }

  Mesh mesh;

 private:
  std::uint32_t vertex(const aiMesh& part, unsigned index) {
    Vertex key{};
    const aiVector3D& p = part.mVertices[index];
    key.position = {p.x, p.y, p.z};
    if (normals_) {
      const aiVector3D& n = part.mNormals[index];
      key.normal = {n.x, n.y, n.z};
    }
    if (uvs_) key.uv = {part.mTextureCoords[0][index].x, part.mTextureCoords[0][index].y};
    const auto [entry, added] =
        known_.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
    if (added) {
      mesh.positions.push_back(to_vector(p));
      if (normals_) mesh.normals.push_back(glm::normalize(glm::dvec3(key.normal)));
      if (uvs_) mesh.uvs.emplace_back(key.uv);
    }
    return entry->second;
  }

  bool normals_;
  bool uvs_;
  std::unordered_map<Vertex, std::uint32_t, VertexHash> known_;
};

void check_faces(const std::filesystem::path& file, const aiScene& scene) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[i];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices == 0) fail(file, "a face has no vertices");
      for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
        if (face.mIndices[corner] >= part.mNumVertices)
          fail(file, "a face names a vertex that is not there");
      }
    }
  }
}

bool usable_normals(const aiMesh& part) {
  if (!part.HasNormals()) return false;
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const double squared = glm::dot(to_vector(part.mNormals[i]), to_vector(part.mNormals[i]));
    if (!(squared > 0 && std::isfinite(squared))) return false;
  }
  return true;
}

Mesh join(const aiScene& scene) {
  bool normals = true;  // one part without them would leave holes in the list
  bool uvs = true;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    normals = normals && usable_normals(*scene.mMeshes[i]);
    uvs = uvs && scene.mMeshes[i]->HasTextureCoords(0);
  }
  MeshBuilder builder(normals, uvs);
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) builder.add(*scene.mMeshes[i]);
  if (builder.mesh.triangles.empty()) throw std::runtime_error("it has no triangles");
  if (builder.mesh.positions.size() > kMostVertices)
    throw std::runtime_error("it has more than 4294967295 vertices");
  return std::move(builder.mesh);
}

}  // namespace

std::shared_ptr<const Mesh> load_mesh(const std::filesystem::path& file) {
  check_readable(file);
  Assimp::Importer importer;
  importer.SetIOHandler(new GuardedFiles);  // owned by the importer
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_LINE | aiPrimitiveType_POINT);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_COLORS | aiComponent_BONEWEIGHTS |
                                  aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                  aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS |
                                  aiComponent_TANGENTS_AND_BITANGENTS);
  // The processing steps abort on faces that make no sense, so these are refused in between.
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_ValidateDataStructure);
  if (scene == nullptr) fail(file, importer.GetErrorString());
  check_faces(file, *scene);
  scene = importer.ApplyPostProcessing(aiProcess_RemoveComponent | aiProcess_Triangulate |
                                       aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr) fail(file, importer.GetErrorString());
  try {
    return std::make_shared<const Mesh>(join(*scene));
  } catch (const std::exception& error) {
    fail(file, error.what());
  }
}

}  // namespace lightbench
