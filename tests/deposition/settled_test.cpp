// Liquid that lies on a surface runs downhill and fills pools.
#include <gmock/gmock.h>

#include "support/rejection.hpp"
#include "tabor/core/random.hpp"
#include "tabor/deposition/deposition.hpp"

namespace tabor::deposition {
namespace {

using testing::HasSubstr;

Grid grid_of(const Field& map) {
  return {map.cols(), map.rows(), static_cast<double>(map.cols()), static_cast<double>(map.rows())};
}

Settled settled(const Field& height, const Field& liquid, Edge edge = Edge::closed) {
  return settle(height, grid_of(height), liquid, edge);
}

/// One row of heights [nm].
Field row_of(std::initializer_list<double> nanometres) {
  Field row(1, static_cast<Index>(nanometres.size()));
  std::copy(nanometres.begin(), nanometres.end(), row.data());
  return 1e-9 * row;
}

Field noise(Index n, std::uint64_t stream) {
  const CounterRandom random(5, stream);
  Field map(n, n);
  for (Index i = 0; i < map.size(); ++i) {
    map(i) = 1e-7 * random.uniform(static_cast<std::uint64_t>(i));
  }
  return map;
}

TEST(SettledLiquid, RunsToTheLowestPlace) {
  const Field height = row_of({30, 20, 0, 10, 40});
  const Settled found = settled(height, row_of({0, 5, 0, 0, 0}));
  EXPECT_TRUE(found.thickness.isApprox(row_of({0, 0, 5, 0, 0}), 1e-6));
  EXPECT_EQ(found.lost, 0);
}

TEST(SettledLiquid, SpillsOverIntoTheNextPool) {
  const Field height = row_of({50, 0, 20, 10, 50});
  const Settled found = settled(height, row_of({0, 25, 0, 0, 0}));
  EXPECT_TRUE(found.thickness.isApprox(row_of({0, 20, 0, 5, 0}), 1e-6)) << 1e9 * found.thickness;
}

TEST(SettledLiquid, RunsOffOpenEdges) {
  const Field height = row_of({0, 10, 5, 10, 0});
  const Settled found = settled(height, row_of({0, 0, 0, 3, 0}), Edge::open);
  EXPECT_NEAR(found.thickness.sum() + 5 * found.lost, 3e-9, 1e-20);
}

TEST(SettledLiquid, AtRestStaysWhereItIs) {
  const Field height = noise(32, 1);
  const Field rained =
      deposit(height, grid_of(height), {.mean_films = {2e-8}, .model = Model::limit})
          .front()
          .thickness;
  EXPECT_LT((settled(height, rained).thickness - rained).abs().maxCoeff(), 1e-12);
}

TEST(SettledLiquid, IsThatOfTheLimitRainWhereItLiesEvenly) {
  const Field height = noise(32, 2);
  for (const double film : {5e-9, 3e-8, 2e-7}) {
    const Field even = Field::Constant(32, 32, film);
    const Field rained =
        deposit(height, grid_of(height), {.mean_films = {film}, .model = Model::limit})
            .front()
            .thickness;
    EXPECT_LT((settled(height, even).thickness - rained).abs().maxCoeff(), 1e-12) << film;
  }
}

TEST(SettledLiquid, KeepsItsVolume) {
  const Field height = noise(48, 3);
  const Field liquid = noise(48, 4);
  for (const Edge edge : {Edge::closed, Edge::periodic, Edge::open}) {
    const Settled found = settled(height, liquid, edge);
    const double all = found.thickness.sum() + 48 * 48 * found.lost;
    EXPECT_NEAR(all / liquid.sum(), 1, 1e-13);
    EXPECT_GE(found.thickness.minCoeff(), 0);
  }
}

TEST(SettledLiquid, IsRejectedWhereItIsNone) {
  const Field height = noise(8, 5);
  const auto message = [&](const Field& liquid) {
    return test::rejection([&] { settled(height, liquid); });
  };
  EXPECT_THAT(message(Field::Constant(8, 8, -1e-9)), HasSubstr("zero or more"));
  EXPECT_THAT(message(Field::Zero(4, 8)), HasSubstr("8 x 4"));
}

}  // namespace
}  // namespace tabor::deposition
