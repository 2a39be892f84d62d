#pragma once
// Scene documents with damage: what the property test feeds the loader.

#include <array>
#include <random>
#include <string>
#include <string_view>

namespace lightbench {

/// Small, but with every key of the format.
inline constexpr std::string_view kWholeScene = R"({"lightbench": 1,
"camera": {"lookFrom": [0,1,5], "lookAt": [0,0,0], "up": [0,1,0], "focalLength": 50,
  "sensorHeight": 24, "fStop": 2.8, "focusDistance": 10, "shutter": [0,1]},
"render": {"resolution": [64,48], "crop": [1,2,30,20], "spp": 10, "timeLimit": 0, "maxDepth": 50,
  "rouletteDepth": 4, "strategy": "mis", "seed": 1, "adaptive": true, "filter": {"type": "gaussian", "radius": 1.5},
  "snapshots": [1,2]},
"display": {"exposure": 0.5, "toneMap": "aces"},
"environment": {"type": "gradient", "color": [0.5,0.7,1], "horizon": [1,1,1], "strength": 1,
  "rotation": 0},
"textures": [{"name": "t", "type": "checker", "colorA": [0,0,0], "colorB": [1,1,1], "scale": 2,
  "useUv": true, "octaves": 7, "seed": 3, "wrap": "clamp", "srgb": true}],
"materials": [{"name": "m", "type": "metal", "baseColor": [1,1,1], "baseColorTexture": "t",
  "fuzz": 0, "roughness": 0.2, "ior": 1.5, "emissive": [1,1,1], "emissiveStrength": 2,
  "emissiveTexture": "t", "twoSided": true}],
"media": [{"name": "fog", "density": 0.1, "albedo": [1,1,1]}],
"meshes": [{"name": "tri", "positions": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]],
  "normals": [[0,0,1],[0,0,1],[0,0,1]], "uvs": [[0,0],[1,0],[0,1]]}],
"objects": [
  {"name": "a", "type": "sphere", "center": [0,0,0], "radius": 1, "motion": [0,1,0],
   "material": "m", "medium": "fog", "visible": false,
   "transform": {"translation": [1,2,3], "rotation": {"axis": [0,1,0], "degrees": 30}, "scale": 2}},
  {"type": "cylinder", "p0": [0,0,0], "p1": [0,1,0], "radius": 1,
   "transform": {"rotation": [0,0,0.6,0.8], "scale": [1,2,3]}},
  {"type": "disc", "center": [0,0,0], "normal": [0,1,0], "radius": 1},
  {"type": "rectangle", "corner": [0,0,0], "edgeU": [1,0,0], "edgeV": [0,1,0]},
  {"type": "triangle", "a": [0,0,0], "b": [1,0,0], "c": [0,1,0]},
  {"type": "pyramid", "vertices": [[0,1,0],[-1,0,-1],[1,0,-1],[0,0,1]]},
  {"type": "box", "min": [0,0,0], "max": [1,1,1]},
  {"type": "mesh", "mesh": "tri"}]})";

/// Numbers, words and punctuation that have broken parsers before.
inline constexpr std::array<std::string_view, 36> kNastyTokens{"-1",
                                                               "0",
                                                               "-0.0",
                                                               "1e308",
                                                               "1e-308",
                                                               "1e400",
                                                               "4294967296",
                                                               "2147483648",
                                                               "-2147483649",
                                                               "NaN",
                                                               "null",
                                                               "true",
                                                               "[]",
                                                               "{}",
                                                               "\"\"",
                                                               "\"m\"",
                                                               "\"\\u0000\"",
                                                               "\"\xff\"",
                                                               "[[[[",
                                                               "]]]]",
                                                               ",",
                                                               ":",
                                                               "\"",
                                                               "\\",
                                                               "\"type\"",
                                                               "\"mesh\"",
                                                               "\"tri\"",
                                                               "0.5",
                                                               "1",
                                                               "2",
                                                               "0.3",
                                                               "0.1",
                                                               "65537",
                                                               "1e19",
                                                               "\"file\": \"/dev/zero\",",
                                                               "\"name\": \"a\","};

/// One to four damages: bytes changed, cut or repeated, numbers and words replaced.
inline std::string damaged(std::string text, std::mt19937& engine) {
  const auto pick = [&engine](std::size_t n) {
    return n == 0 ? 0 : static_cast<std::size_t>(engine()) % n;
  };
  for (std::size_t count = 1 + pick(4); count-- > 0;) {
    const std::size_t at = pick(text.size());
    switch (pick(9)) {
      case 0:
        text[at] = static_cast<char>(engine());
        break;
      case 1:
        text.erase(at, 1 + pick(12));
        break;
      case 2:
        text.insert(at, text.substr(pick(text.size()), 1 + pick(40)));
        break;
      case 3:
        text.insert(at, kNastyTokens[pick(kNastyTokens.size())]);
        break;
      default: {  // a whole number or word, so that what follows still parses
        const std::size_t begin = text.find_first_of("0123456789-\"", at);
        if (begin == std::string::npos) break;
        const std::size_t end = text[begin] == '"' ? text.find('"', begin + 1) + 1
                                                   : text.find_first_of(",]} \n", begin);
        if (end > begin && end <= text.size())
          text.replace(begin, end - begin, kNastyTokens[pick(kNastyTokens.size())]);
      }
    }
    if (text.empty()) text = "x";
  }
  return text;
}

}  // namespace lightbench
