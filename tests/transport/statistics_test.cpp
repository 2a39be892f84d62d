// The judge itself: its quantiles, that it acquits the innocent as often as it says, and that it
// catches a planted bias.

#include "tests/transport/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "app/proof/build_scene.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

TEST(Statistics, LimitsAreTheTablesOnes) {
  EXPECT_NEAR(sidak_limit(0.05, 1), 1.959964, 1e-5);
  EXPECT_NEAR(sidak_limit(0.001, 1), 3.290527, 1e-5);
  // 1 - (1 - 0.001)^(1/100) = 1.0005e-5 in two tails.
  EXPECT_NEAR(sidak_limit(0.001, 100), 4.4171, 1e-3);
}

TEST(Statistics, StudentsTBecomesTheNormalDeviateOfTheSameTail) {
  // Quantiles of t at the tail of the normal 3.290527 (0.0005 each side).
  EXPECT_NEAR(equivalent_z(4.0728, 15), 3.2905, 0.02);
  EXPECT_NEAR(equivalent_z(3.6335, 31), 3.2905, 0.02);
  EXPECT_NEAR(equivalent_z(-3.3, 1023), -3.2905, 0.01);
}

TEST(Statistics, StudentsTailsAreTheTablesOnes) {
  EXPECT_NEAR(student_tail(12.7062, 1), 0.05, 1e-6);
  EXPECT_NEAR(student_tail(-2.228139, 10), 0.05, 1e-7);
  EXPECT_NEAR(student_tail(4.587, 10), 0.001, 1e-6);
  EXPECT_NEAR(student_tail(1.959964, 1e7), 0.05, 1e-6);
  EXPECT_EQ(student_tail(0, 5), 1);
  EXPECT_NEAR(student_quantile(0.05, 1), 12.7062, 1e-4);
  EXPECT_NEAR(student_quantile(0.05, 10), 2.228139, 1e-6);
}

TEST(Statistics, WelchsTestIsTheTextbooksOne) {
  // Means 20 and 22, variances 1 and 4, of 10 and 20 values.
  const Welch w = welch({20, std::sqrt(0.1), 9}, {22, std::sqrt(0.2), 19});
  EXPECT_NEAR(w.t, -3.651484, 1e-6);
  EXPECT_NEAR(w.freedom, 0.09 / (0.01 / 9 + 0.04 / 19), 1e-9);
  EXPECT_NEAR(w.p, student_tail(-3.651484, w.freedom), 1e-8);
}

// Differences of means of unequal noise: p-values are uniform, and families of them are rejected as
// often as stated.
TEST(Statistics, PValuesOfEqualMeansAreUniform) {
  std::mt19937 engine(5);
  std::normal_distribution<double> quiet(1, 0.1), loud(1, 0.5);
  int rejected = 0;
  const int families = 1000;
  for (int f = 0; f < families; ++f) {
    std::vector<double> p;
    for (int i = 0; i < 50; ++i) {
      std::vector<double> a, b;
      for (int k = 0; k < 12; ++k) a.push_back(quiet(engine));
      for (int k = 0; k < 8; ++k) b.push_back(loud(engine));
      p.push_back(welch(mean_of(a), mean_of(b)).p);
    }
    rejected += uniformity(p) < 0.01 ? 1 : 0;
  }
  // Ten expected; Poisson stays within 2 and 22 with probability 0.999.
  EXPECT_GE(rejected, 2);
  EXPECT_LE(rejected, 22);
  EXPECT_LT(uniformity(std::vector<double>(50, 0.5)), 1e-6);
  EXPECT_LT(uniformity({0.1, 0.2, NAN}), 1e-6);
}

TEST(Statistics, FamiliesOfTrueValuesFailAsOftenAsStated) {
  std::mt19937 engine(11);
  std::normal_distribution<double> noise(1, 0.3);
  int failures = 0;
  const int families = 4000;
  for (int f = 0; f < families; ++f) {
    Family family(1, 0);
    for (int member = 0; member < 5; ++member) {
      std::vector<glm::dvec3> replicates;
      for (int i = 0; i < 32; ++i) replicates.emplace_back(noise(engine));
      family.add("", 1, summarize(replicates));
    }
    failures += !family.disagreements().empty();
  }
  // Four expected; Poisson stays below 13 with probability 0.9999.
  EXPECT_LE(failures, 13);
}

TEST(Statistics, NotANumberDisagrees) {
  Family family(1, 0);
  Estimate e{glm::dvec3(NAN), glm::dvec3(0.1), 31};
  family.add("nan", 1, e);
  EXPECT_EQ(family.disagreements().size(), 1U);
}

// The tests of this folder would notice half a percent, at the samples that they use.
TEST(Statistics, APlantedBiasIsFound) {
  if (kThinning > 1) GTEST_SKIP() << "takes more samples than a watched kernel can";
  for (const KernelUnderTest& kernel : {kFastKernel, kReferenceKernel}) {
    for (const double bias : {1.0, 1.005, 0.995}) {
      Scene s = dark_scene();
      add(s, RectangleShape{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, lambertian(glm::dvec3(0.5)));
      add(s, SphereShape{{0, 2, 0}, 0.5, {0, 0, 0}}, light(glm::dvec3(bias)));
      add(s, BoxShape{{1, 0.5, -0.5}, {1.5, 1.5, 0.5}}, light(glm::dvec3(bias)));
      aim(s, {-4, 0.5, 3}, glm::dvec3(0));
      Family family = kernel.family();
      // Without bias: the mean of a render with many times the samples.
      static const double truth = [&] {
        Scene t = s;
        for (Material& m : t.materials) m.emissive = m.emissive / bias;
        t.render.seed = 99;
        return measure_uniform(t, KernelKind::Auto, 8192).mean.y;
      }();
      family.add("bias", truth, measure_uniform(s, kernel.kind, kernel.spp(2048)));
      EXPECT_EQ(family.disagreements().size(), bias == 1 ? 0U : 1U) << kernel << " bias " << bias;
      EXPECT_TRUE(family.imprecise().empty());
    }
  }
}

}  // namespace
}  // namespace lightbench
