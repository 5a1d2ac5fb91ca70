#include "tabor/core/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/refusal.hpp"
#include "tabor/core/error.hpp"

namespace tabor {
namespace {

using test::refusal;
using testing::HasSubstr;

TEST(ParseQuantity, TurnsUnitsIntoSi) {
  EXPECT_DOUBLE_EQ(parse_si("7 MPa", dimension::pressure, "--pressure"), 7e6);
  EXPECT_DOUBLE_EQ(parse_si("7MPa", dimension::pressure, "--pressure"), 7e6);
  EXPECT_DOUBLE_EQ(parse_si("0.45 g/m^2", dimension::areal_density, "--density"), 0.45e-3);
  EXPECT_DOUBLE_EQ(parse_si("0.45g/m2", dimension::areal_density, "--density"), 0.45e-3);
  EXPECT_DOUBLE_EQ(parse_si("900 kg/m³", dimension::density, "--oil-density"), 900);
  EXPECT_DOUBLE_EQ(parse_si("0.1 Pa s", dimension::viscosity, "viscosity"), 0.1);
  EXPECT_DOUBLE_EQ(parse_si("0.1Pa*s", dimension::viscosity, "viscosity"), 0.1);
  EXPECT_DOUBLE_EQ(parse_si("1.522e-8 1/Pa", dimension::per_pressure, "alpha"), 1.522e-8);
  EXPECT_DOUBLE_EQ(parse_si("1 N/mm^2", dimension::pressure, "--pressure"), 1e6);
  EXPECT_DOUBLE_EQ(parse_si("0.33", dimension::none, "--poisson-ratio"), 0.33);
}

TEST(ParseQuantity, KnowsTheMicroSignInAllItsEncodings) {
  for (const char* text : {"3um", "3µm", "3\u03bcm", "3\xb5m"}) {
    EXPECT_DOUBLE_EQ(parse_si(text, dimension::length, "--pixel"), 3e-6) << text;
  }
}

TEST(ParseQuantity, NamesTheCorrectedFormWhenTheUnitIsMissing) {
  EXPECT_THAT(refusal([] { parse_si("7", dimension::pressure, "--pressure"); }),
              HasSubstr("--pressure 7MPa"));
}

TEST(ParseQuantity, RefusesUnitsOfAnotherDimension) {
  EXPECT_THAT(refusal([] { parse_si("7 um", dimension::pressure, "--pressure"); }),
              HasSubstr("MPa"));
}

TEST(ParseQuantity, NamesTheUnknownUnit) {
  EXPECT_THAT(refusal([] { parse_si("7 Mpa", dimension::pressure, "--pressure"); }),
              HasSubstr("'Mpa'"));
}

TEST(ParseQuantity, RefusesPowersThatMeanNothing) {
  EXPECT_DOUBLE_EQ(parse_si("1 m^9/m8", dimension::length, "--pixel"), 1);
  EXPECT_THAT(refusal([] { parse_si("1 m^10/m^9", dimension::length, "--pixel"); }),
              HasSubstr("'m^10'"));
  EXPECT_FALSE(unit_factor("l1350808505", dimension::length).has_value());
  EXPECT_FALSE(unit_factor("l-2147483648", dimension::length).has_value());
}

TEST(ParseQuantity, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"", "MPa", "nan MPa", "inf MPa", "1e999 MPa", "--7 MPa"}) {
    EXPECT_THROW(parse_si(text, dimension::pressure, "--pressure"), InputError) << text;
  }
}

TEST(ParseQuantityList, ReadsEachValueWithItsOwnUnit) {
  EXPECT_EQ(parse_si_list("2MPa,500kPa", dimension::pressure, "--pressure"),
            (std::vector<double>{2e6, 5e5}));
  EXPECT_THROW(parse_si_list("2MPa,,7MPa", dimension::pressure, "--pressure"), InputError);
  EXPECT_THROW(parse_si_list("2MPa,7", dimension::pressure, "--pressure"), InputError);
}

TEST(UnitFactor, KnowsLengthsOfInstrumentFilesOnly) {
  EXPECT_DOUBLE_EQ(unit_factor("nm", dimension::length).value(), 1e-9);
  EXPECT_DOUBLE_EQ(unit_factor("Å", dimension::length).value(), 1e-10);
  EXPECT_FALSE(unit_factor("V", dimension::length).has_value());
  EXPECT_FALSE(unit_factor("Pa", dimension::length).has_value());
}

TEST(FormatSi, ChoosesTheEngineeringPrefix) {
  EXPECT_EQ(format_si(6.7e-7, "m"), "670 nm");
  EXPECT_EQ(format_si(7e6, "Pa"), "7 MPa");
  EXPECT_EQ(format_si(0, "m"), "0 m");
  EXPECT_EQ(format_si(-2.5e-6, "m"), "-2.5 µm");
  EXPECT_EQ(format_si(1e-3, "m"), "1 mm");
}

}  // namespace
}  // namespace tabor
