#include "tabor/forming/unit_system.hpp"

#include <gmock/gmock.h>

#include "tabor/core/error.hpp"

namespace tabor::forming {
namespace {

struct Known {
  const char* words;
  const char* pressure;
  double pascals;
  const char* speed;
  double metres_per_second;
  const char* density;
  double kilograms_per_square_metre;
};

class UnitSystems : public testing::TestWithParam<Known> {};

TEST_P(UnitSystems, AreConsistent) {
  const Known& known = GetParam();
  const UnitSystem units = unit_system(known.words);
  EXPECT_EQ(units.words, known.words);
  EXPECT_EQ(units.pressure.name, known.pressure);
  EXPECT_DOUBLE_EQ(units.pressure.si, known.pascals);
  EXPECT_EQ(units.speed.name, known.speed);
  EXPECT_DOUBLE_EQ(units.speed.si, known.metres_per_second);
  EXPECT_EQ(units.areal_density.name, known.density);
  EXPECT_DOUBLE_EQ(units.areal_density.si, known.kilograms_per_square_metre);
}

// psi: 1 lbf = 4.4482216152605 N, 1 in = 0.0254 m (NIST SP 811).
constexpr double kPsi = 4.4482216152605 / (0.0254 * 0.0254);

INSTANTIATE_TEST_SUITE_P(OfFormingCodes, UnitSystems,
                         testing::Values(Known{"mm,s,t", "MPa", 1e6, "mm/s", 1e-3, "t/mm^2", 1e9},
                                         Known{"t, mm, s", "MPa", 1e6, "mm/s", 1e-3, "t/mm^2", 1e9},
                                         Known{"m,s,kg", "Pa", 1, "m/s", 1, "kg/m^2", 1},
                                         Known{"kg,mm,ms", "GPa", 1e9, "mm/ms", 1, "kg/mm^2", 1e6},
                                         Known{"g,mm,ms", "MPa", 1e6, "mm/ms", 1, "g/mm^2", 1e3},
                                         Known{"cm,us,g", "Mbar", 1e11, "cm/us", 1e4, "g/cm^2", 10},
                                         Known{"mm,s,kg", "kPa", 1e3, "mm/s", 1e-3, "kg/mm^2", 1e6},
                                         Known{"mm,s,g", "Pa", 1, "mm/s", 1e-3, "g/mm^2", 1e3},
                                         Known{"cm,s,g", "g/(cm s^2)", 0.1, "cm/s", 1e-2, "g/cm^2",
                                               10}),
                         [](const auto& test) { return "Number" + std::to_string(test.index); });

TEST(UnitSystem, HasForcesInThePlaceOfMasses) {
  const UnitSystem by_force = unit_system("N,mm,s");
  const UnitSystem by_mass = unit_system("mm,s,t");
  EXPECT_EQ(by_force.pressure.name, "MPa");
  EXPECT_DOUBLE_EQ(by_force.pressure.si, by_mass.pressure.si);
  EXPECT_DOUBLE_EQ(by_force.areal_density.si, by_mass.areal_density.si);
  const UnitSystem imperial = unit_system("in,s,lbf");
  EXPECT_EQ(imperial.pressure.name, "psi");
  EXPECT_NEAR(imperial.pressure.si, kPsi, 1e-9 * kPsi);
  EXPECT_DOUBLE_EQ(imperial.speed.si, 0.0254);
  EXPECT_EQ(imperial.areal_density.name, "lbf s^2/in^3");
  EXPECT_NEAR(imperial.areal_density.si, kPsi / 0.0254, 1e-9 * kPsi / 0.0254);
}

TEST(UnitSystem, OfASlugIsThatOfAPoundForceAndAFoot) {
  EXPECT_EQ(unit_system("ft,s,slug").pressure.name, "psf");
  EXPECT_NEAR(unit_system("ft,s,slug").pressure.si, unit_system("ft,s,lbf").pressure.si, 1e-12);
}

TEST(UnitSystem, RejectsWhatIsNone) {
  for (const char* words : {"", "mm", "mm,s", "mm,s,t,", "mm,s,t,kg", "mm,m,t", "mm,ms,s", "t,kg,s",
                            "mm,s,MPa", "mm;s;t", "mm,s,T"}) {
    EXPECT_THROW(unit_system(words), InputError) << words;
  }
  try {
    unit_system("mm,s");
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("without a mass or force"));
  }
}

}  // namespace
}  // namespace tabor::forming
