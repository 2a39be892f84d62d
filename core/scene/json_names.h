#pragma once
// The words of the scene format for each enumeration and shape; reader and writer share them.

#include "core/scene/json_cursor.h"
#include "core/scene/scene.h"

namespace lightbench {

inline constexpr int kFormatVersion = 1;

inline constexpr Names<TextureKind, 6> kTextureKinds{{{"constant", TextureKind::Constant},
                                                      {"image", TextureKind::Image},
                                                      {"checker", TextureKind::Checker},
                                                      {"noise", TextureKind::Noise},
                                                      {"turbulence", TextureKind::Turbulence},
                                                      {"marble", TextureKind::Marble}}};

inline constexpr Names<WrapMode, 3> kWrapModes{
    {{"repeat", WrapMode::Repeat}, {"clamp", WrapMode::Clamp}, {"mirror", WrapMode::Mirror}}};

inline constexpr Names<MaterialKind, 4> kMaterialKinds{{{"lambertian", MaterialKind::Lambertian},
                                                        {"metal", MaterialKind::Metal},
                                                        {"dielectric", MaterialKind::Dielectric},
                                                        {"emissive", MaterialKind::Emissive}}};

inline constexpr Names<EnvironmentKind, 3> kEnvironmentKinds{
    {{"constant", EnvironmentKind::Constant},
     {"gradient", EnvironmentKind::Gradient},
     {"image", EnvironmentKind::Image}}};

inline constexpr Names<FilterKind, 3> kFilterKinds{{{"box", FilterKind::Box},
                                                    {"triangle", FilterKind::Triangle},
                                                    {"gaussian", FilterKind::Gaussian}}};

inline constexpr Names<Strategy, 3> kStrategies{
    {{"mis", Strategy::Mis}, {"lights", Strategy::Lights}, {"bsdf", Strategy::Bsdf}}};

inline constexpr Names<LightChoiceBy, 3> kLightChoices{
    {{"images", LightChoiceBy::Images},
     {"contribution", LightChoiceBy::Contribution},
     {"power", LightChoiceBy::Power}}};

inline constexpr Names<SamplerKind, 2> kSamplers{
    {{"sobol", SamplerKind::Sobol}, {"independent", SamplerKind::Independent}}};

inline constexpr Names<ToneMap, 3> kToneMaps{
    {{"srgb", ToneMap::Srgb}, {"reinhard", ToneMap::Reinhard}, {"aces", ToneMap::Aces}}};

/// By index into the variant Shape.
inline constexpr Names<std::size_t, std::variant_size_v<Shape>> kShapeTypes{{{"sphere", 0},
                                                                             {"cylinder", 1},
                                                                             {"disc", 2},
                                                                             {"rectangle", 3},
                                                                             {"triangle", 4},
                                                                             {"pyramid", 5},
                                                                             {"box", 6},
                                                                             {"mesh", 7}}};

/// The word for `value`.
template <class T, std::size_t N>
const char* name_of(const Names<T, N>& names, T value) {
  for (const auto& [name, known] : names)
    if (known == value) return name;
  return "";
}

}  // namespace lightbench
