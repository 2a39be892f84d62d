// Every way a scene document can be wrong, and the words that say so.

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

struct BadScene {
  const char* members;  ///< after "lightbench": 1
  const char* message;  ///< after the label; all of it
};

std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    static_cast<void>(parse_scene(text, "/nowhere", "bad.json", overrides));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

std::string document(const std::string& members) { return R"({"lightbench": 1, )" + members + "}"; }
std::string object(const std::string& members) {
  return document(R"("objects": [{)" + members + "}]");
}

void expect_error(const std::string& text, const std::string& message) {
  EXPECT_EQ(error_of(text), "bad.json: " + message) << text;
}

TEST(SceneErrors, SyntaxNamesLineAndColumn) {
  EXPECT_NE(error_of("{\n  \"lightbench\": 1,\n  oops\n}").find("line 3, column 3"),
            std::string::npos);
  EXPECT_NE(error_of("").find("parse error"), std::string::npos);
  EXPECT_NE(error_of("{\"lightbench\": 1e999}").find("number overflow"), std::string::npos);
  EXPECT_NE(error_of("{\"lightbench\": \"\xff\"}").find("ill-formed UTF-8"), std::string::npos);
  EXPECT_NE(error_of(R"({"lightbench": 1} x)").find("parse error"), std::string::npos);
  EXPECT_NE(error_of(document(R"("render": {"spp": NaN})")).find("parse error"), std::string::npos);
}

TEST(SceneErrors, NestingIsBounded) {
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  expect_error(document("\"objects\": " + deep), "expected at most 32 levels of nesting");
}

TEST(SceneErrors, RootAndVersion) {
  expect_error("[]", "expected an object, got []");
  expect_error("{}", "expected a key \"lightbench\"");
  expect_error(R"({"lightbench": 2})", "/lightbench: expected format version 1, got 2");
  expect_error(R"({"lightbench": "1"})", R"(/lightbench: expected format version 1, got "1")");
}

TEST(SceneErrors, Members) {
  const BadScene rows[] = {
      // keys
      {R"("objets": [])", R"(unknown key "objets", did you mean "objects"?)"},
      {R"("qwertyuiop": [])", R"(unknown key "qwertyuiop")"},
      {R"("camera": {"look_from": [0,0,1]})",
       R"(/camera: unknown key "look_from", did you mean "lookFrom"?)"},
      {R"("camera": {"vfov": 40, "vfov": 50})", R"(the key "vfov" appears twice)"},
      {R"("render": {"filter": {"kind": "box"}})", R"(/render/filter: unknown key "kind")"},
      {R"("display": {"tonemap": "aces"})",
       R"(/display: unknown key "tonemap", did you mean "toneMap"?)"},
      {R"("environment": {"colour": [0,0,0]})",
       R"(/environment: unknown key "colour", did you mean "color"?)"},
      {R"("textures": [{"name": "t", "type": "constant", "colour": 1}])",
       R"(/textures/0: unknown key "colour", did you mean "colorA"?)"},
      {R"("materials": [{"name": "m", "type": "metal", "rougness": 0.1}])",
       R"(/materials/0: unknown key "rougness", did you mean "roughness"?)"},
      {R"("media": [{"name": "m", "densty": 1}])",
       R"(/media/0: unknown key "densty", did you mean "density"?)"},
      {R"("meshes": [{"name": "m", "filename": "a.ply"}])", R"(/meshes/0: unknown key "filename")"},
      {R"("a/b~c": 1)", R"(unknown key "a/b~c")"},
      // types
      {R"("camera": [])", "/camera: expected an object, got []"},
      {R"("camera": {"lookFrom": [1, 2]})",
       "/camera/lookFrom: expected an array of 3 numbers, got [1,2]"},
      {R"("camera": {"lookFrom": 5})", "/camera/lookFrom: expected an array of 3 numbers, got 5"},
      {R"("camera": {"lookFrom": [1, 2, "x"]})",
       R"(/camera/lookFrom/2: expected a number, got "x")"},
      {R"("camera": {"vfov": "wide"})", R"(/camera/vfov: expected a number, got "wide")"},
      {R"("camera": {"vfov": null})", "/camera/vfov: expected a number, got null"},
      {R"("camera": {"shutter": 1})", "/camera/shutter: expected an array of 2 numbers, got 1"},
      {R"("render": {"spp": 10.5})", "/render/spp: expected an integer, got 10.5"},
      {R"("render": {"spp": 3000000000})",
       "/render/spp: expected an integer below 2147483648, got 3000000000"},
      {R"("render": {"seed": -1})",
       "/render/seed: expected an integer from 0 to 4294967295, got -1"},
      {R"("render": {"resolution": [1, 2, 3]})",
       "/render/resolution: expected an array of 2 elements, got [1,2,3]"},
      {R"("render": {"crop": true})", "/render/crop: expected an array of 4 elements, got true"},
      {R"("render": {"snapshots": 10})", "/render/snapshots: expected an array, got 10"},
      {R"("render": {"snapshots": [10, "20"]})",
       R"(/render/snapshots/1: expected an integer, got "20")"},
      {R"("render": {"filter": "box"})", R"(/render/filter: expected an object, got "box")"},
      {R"("textures": {})", "/textures: expected an array, got an object"},
      {R"("textures": [1])", "/textures/0: expected an object, got 1"},
      {R"("textures": [{"name": "t", "type": "checker", "useUv": 1}])",
       "/textures/0/useUv: expected true or false, got 1"},
      {R"("textures": [{"name": 3, "type": "checker"}])",
       "/textures/0/name: expected a string, got 3"},
      {R"("meshes": [{"name": "m", "positions": [[0,0,0]], "triangles": [[0,1]]}])",
       "/meshes/0/triangles/0: expected an array of 3 vertex indices, got [0,1]"},
      {R"("meshes": [{"name": "m", "positions": [[0,0,0]], "triangles": [[0,0,-1]]}])",
       "/meshes/0/triangles/0/2: expected an integer from 0 to 4294967295, got -1"},
      {R"("meshes": [{"name": "m", "positions": [0,1,2,3,4,5], "triangles": []}])",
       "/meshes/0/positions/0: expected an array of 3 numbers, got 0"},
      // words
      {R"("textures": [{"name": "t", "type": "cheker"}])",
       "/textures/0/type: expected constant, image, checker, noise, turbulence or marble, got "
       "\"cheker\", did you mean \"checker\"?"},
      {R"("textures": [{"name": "t", "type": "image", "wrap": "tile"}])",
       R"(/textures/0/wrap: expected repeat, clamp or mirror, got "tile")"},
      {R"("materials": [{"name": "m", "type": "plastic"}])",
       R"(/materials/0/type: expected lambertian, metal, dielectric or emissive, got "plastic")"},
      {R"("environment": {"type": "sky"})",
       R"(/environment/type: expected constant, gradient or image, got "sky")"},
      {R"("render": {"filter": {"type": "tent"}})",
       R"(/render/filter/type: expected box, triangle or gaussian, got "tent")"},
      {R"("render": {"strategy": "nee"})",
       R"(/render/strategy: expected mis, lights or bsdf, got "nee")"},
      {R"("display": {"toneMap": "filmic"})",
       R"(/display/toneMap: expected srgb, reinhard or aces, got "filmic")"},
      // missing
      {R"("textures": [{"type": "checker"}])", R"(/textures/0: expected a key "name")"},
      {R"("textures": [{"name": "t"}])", R"(/textures/0: expected a key "type")"},
      {R"("materials": [{"name": "m"}])", R"(/materials/0: expected a key "type")"},
      {R"("media": [{"density": 1}])", R"(/media/0: expected a key "name")"},
      {R"("meshes": [{"name": "m"}])", "/meshes/0: expected file, or positions and triangles"},
      {R"("meshes": [{"name": "m", "positions": []}])",
       "/meshes/0: expected file, or positions and triangles"},
      // exclusive
      {R"("meshes": [{"name": "m", "file": "a.ply", "positions": []}])",
       "/meshes/0: expected file, or positions and triangles, got both"},
      {R"("camera": {"vfov": 40, "focalLength": 50})",
       "/camera: expected vfov or focalLength, got both"},
      {R"("camera": {"lensRadius": 1, "fStop": 2})",
       "/camera: expected lensRadius or fStop, got both"},
      {R"("camera": {"focalLength": 0})", "/camera/focalLength: expected a positive number, got 0"},
      {R"("camera": {"fStop": -2})", "/camera/fStop: expected a positive number, got -2"},
      // names
      {R"("materials": [{"name": "a", "type": "metal"}, {"name": "a", "type": "metal"}])",
       R"(/materials/1/name: expected a name of its own, got "a" for a second time)"},
      {R"("textures": [{"name": "", "type": "checker"}])",
       R"(/textures/0/name: expected a name, got "")"},
      {R"("textures": [{"name": "t", "type": "checker"}, {"name": "t", "type": "checker"}])",
       R"(/textures/1/name: expected a name of its own, got "t" for a second time)"},
      {R"("media": [{"name": "t"}, {"name": "t"}])",
       R"(/media/1/name: expected a name of its own, got "t" for a second time)"},
      {R"("objects": [{"type": "box", "name": "x\n"}, {"type": "box", "name": "x\n"}])",
       R"(/objects/1/name: expected a name of its own, got "x\n" for a second time)"},
      // references
      {R"("materials": [{"name": "m", "type": "metal", "baseColorTexture": "t"}])",
       R"(/materials/0/baseColorTexture: no texture is named "t")"},
      {R"("materials": [{"name": "m", "type": "metal", "emissiveTexture": 0}])",
       "/materials/0/emissiveTexture: expected a string, got 0"},
      // files
      {R"("textures": [{"name": "t", "type": "image"}])",
       "/textures/0/file: expected an image file, got none"},
      {R"("environment": {"type": "image"})",
       "/environment/file: expected an image file, got none"},
      {R"("textures": [{"name": "t", "type": "image", "file": "no.png"}])",
       "/textures/0/file: /nowhere/no.png: cannot be read: No such file or directory"},
      {R"("environment": {"type": "image", "file": "../no.exr"})",
       "/environment/file: /no.exr: cannot be read: No such file or directory"},
      {R"("meshes": [{"name": "m", "file": "no.ply"}])",
       "/meshes/0/file: /nowhere/no.ply: cannot be read: No such file or directory"},
      {R"("textures": [{"name": "t", "type": "image", "file": "/dev/zero"}])",
       "/textures/0/file: /dev/zero: cannot be read: not a regular file"},
      {R"("meshes": [{"name": "m", "file": "/tmp"}])",
       "/meshes/0/file: /tmp: cannot be read: not a regular file"},
  };
  for (const BadScene& row : rows) expect_error(document(row.members), row.message);
}

TEST(SceneErrors, Objects) {
  const BadScene rows[] = {
      {R"("name": "x")", R"(/objects/0: expected a key "type")"},
      {R"("type": "torus")",
       "/objects/0/type: expected sphere, cylinder, disc, rectangle, triangle, pyramid, box or "
       "mesh, got \"torus\""},
      {R"("type": "sphere", "radius": -2)",
       "/objects/0/radius: expected a positive number, got -2"},
      {R"("type": "sphere", "radius": "2")", R"(/objects/0/radius: expected a number, got "2")"},
      {R"("type": "sphere", "centre": [0,0,0])",
       R"(/objects/0: unknown key "centre", did you mean "center"?)"},
      {R"("type": "box", "radius": 1)", R"(/objects/0: unknown key "radius")"},
      {R"("type": "pyramid", "vertices": [[0,0,0]])",
       "/objects/0/vertices: expected an array of 4 elements, got an array of 1 element"},
      {R"("type": "mesh")", R"(/objects/0: expected a key "mesh")"},
      {R"("type": "mesh", "mesh": "bunny")", R"(/objects/0/mesh: no mesh is named "bunny")"},
      {R"("type": "box", "medium": "fog")", R"(/objects/0/medium: no medium is named "fog")"},
      {R"("type": "box", "visible": "yes")",
       R"(/objects/0/visible: expected true or false, got "yes")"},
      {R"("type": "box", "transform": {"rotate": 5})",
       R"(/objects/0/transform: unknown key "rotate")"},
      {R"("type": "box", "transform": {"rotation": 5})",
       "/objects/0/transform/rotation: expected an object, got 5"},
      {R"("type": "box", "transform": {"rotation": {"angle": 5}})",
       R"(/objects/0/transform/rotation: unknown key "angle")"},
      {R"("type": "box", "transform": {"rotation": [0, 0, 1]})",
       "/objects/0/transform/rotation: expected an array of 4 elements, got [0,0,1]"},
      {R"("type": "box", "transform": {"rotation": [0, 0, 0, 0]})",
       "/objects/0/transform/rotation: expected a quaternion [x, y, z, w] that is not zero, got "
       "[0,0,0,0]"},
      {R"("type": "box", "transform": {"scale": "big"})",
       R"(/objects/0/transform/scale: expected a number or an array of 3 numbers, got "big")"},
      {R"("type": "box", "transform": {"scale": 0})",
       "/objects/0/transform/scale: expected factors from 1e-12 to 1e+12, either sign, got [0, 0, "
       "0]"},
  };
  for (const BadScene& row : rows) expect_error(object(row.members), row.message);
}

TEST(SceneErrors, MisspeltReferenceSuggestsAName) {
  expect_error(document(R"("materials": [{"name": "glass", "type": "dielectric"}],
                           "objects": [{"type": "box", "material": "Glas"}])"),
               R"(/objects/0/material: no material is named "Glas", did you mean "glass"?)");
}

TEST(SceneErrors, LongValuesAreShortened) {
  const std::string message =
      error_of(document(R"("camera": {"vfov": ")" + std::string(5000, 'x') + R"("})"));
  EXPECT_LT(message.size(), 150U);
  EXPECT_NE(message.find("..."), std::string::npos);
}

TEST(SceneErrors, MissingFileIsNamed) {
  try {
    static_cast<void>(load_scene("/nowhere/at-all.json"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_STREQ(error.what(), "/nowhere/at-all.json: cannot be read: No such file or directory");
  }
}

struct BadOverride {
  Override change;
  const char* message;
};

TEST(SceneErrors, Overrides) {
  const BadOverride rows[] = {
      {{"render/spp", "5"}, "render/spp: expected a JSON pointer such as /render/spp"},
      {{"", "5"}, ": expected a JSON pointer such as /render/spp"},
      {{"/render/~2", "5"}, "/render/~2: expected ~0 or ~1 after ~ in a JSON pointer"},
      {{"/render/spq", "5"}, R"(/render: unknown key "spq", did you mean "spp"?)"},
      {{"/render/spp", "many"}, R"(/render/spp: expected an integer, got "many")"},
      {{"/render/spp", "1e999"}, R"(/render/spp: expected an integer, got "1e999")"},
      {{"/lightbench/x", "5"}, R"(/lightbench/x: expected an object or an array above "x", got 1)"},
      {{"/objects/1/radius", "5"},
       R"(/objects/1/radius: expected an element below 1 or its name, got "1")"},
      {{"/objects/bal/radius", "5"},
       "/objects/bal/radius: expected an element below 1 or its name, got \"bal\", did you mean "
       "\"ball\"?"},
      {{"/objects/ball/radius", "-5"}, "/objects/0/radius: expected a positive number, got -5"},
      {{"/objects/99999999999/radius", "5"},
       "/objects/99999999999/radius: expected an element below 1 or its name, got "
       "\"99999999999\""},
  };
  for (const BadOverride& row : rows) {
    EXPECT_EQ(error_of(object(R"("type": "sphere", "name": "ball")"), {row.change}),
              std::string("bad.json: ") + row.message);
  }
}

}  // namespace
}  // namespace lightbench
