#pragma once

#include <string>

#include "tabor/core/names.hpp"
#include "tabor/forming/friction_table.hpp"
#include "tabor/forming/unit_system.hpp"

// Writes friction tables in the formats of forming codes, as their manuals describe them. Each
// function returns the text of a file: comments with content and units, then the cards. All throw
// InputError for a table that the format cannot hold.
namespace tabor::forming {

/// Program that a table is for; csv for all others.
enum class Program { abaqus, lsdyna, ansys, openradioss, csv };
inline constexpr auto kPrograms = names<Program>("abaqus", "lsdyna", "ansys", "openradioss", "csv");

/// Writes *SURFACE INTERACTION with *FRICTION: mu, slip rate, pressure, temperature, and where
/// there are several densities the density as the first field variable. (Abaqus Keywords Guide,
/// *FRICTION.)
std::string abaqus_deck(const FrictionTable& table, const UnitSystem& units);

/// Writes a *DEFINE_TABLE over pressure for each density, each followed by one *DEFINE_CURVE over
/// sliding speed per pressure; numbers of tables and curves count up from `first_id`. (LS-DYNA
/// Keyword User's Manual, *DEFINE_TABLE, *CONTACT: FS = 2.) All curves of a table must have the
/// same speeds: complete_rows().
std::string lsdyna_deck(const FrictionTable& table, const UnitSystem& units, int first_id = 1);

/// Writes TB,FRIC with TBFIELD over NPRES and SLRV: one material for each density, counted up from
/// `first_id`. (Ansys Mechanical APDL Material Reference, Contact Friction.)
std::string ansys_deck(const FrictionTable& table, const UnitSystem& units, int first_id = 1);

/// Writes /FRICTION with Ifric = 2, the law of darmstad.hpp fitted to the numbers: one for each
/// density, counted up from `first_id`. (OpenRadioss Reference Guide, /FRICTION.)
std::string openradioss_deck(const FrictionTable& table, const UnitSystem& units, int first_id = 1);

/// Writes a line per number, the units in the names of the columns, comments after '#'. One
/// pressure is enough.
std::string table_csv(const FrictionTable& table, const UnitSystem& units);

/// Writes the file for a program; `first_id` is used where its format has numbers.
std::string deck_for(Program program, const FrictionTable& table, const UnitSystem& units,
                     int first_id = 1);

}  // namespace tabor::forming
