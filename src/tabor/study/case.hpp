#pragma once

#include <string>
#include <vector>

#include "tabor/study/study.hpp"

namespace tabor::study {

/// One thing the store keeps. Its text states everything its result depends on, in SI with 17
/// digits; its key, the first 16 hexadecimal digits of the text's SHA-256, names its file. Change
/// kAlgorithms when the same text gives other numbers than before.
struct Unit {
  std::string text;
  std::string key;
  std::string file;  ///< name inside DIR/store
};

inline constexpr int kAlgorithms = 4;
inline constexpr int kFluidAlgorithms = 1;  ///< the same for films that flow alone

/// The treated scan; `scan_sha256` is of the scan file's bytes.
Unit surface_unit(const Study& study, const Scan& scan, const std::string& scan_sha256);

/// One contact: surface and pressure.
Unit contact_unit(const Study& study, const Unit& surface, double mean_pressure);

/// The films of all densities on one surface.
Unit film_unit(const Study& study, const Unit& surface);

/// The film that flows between one contact's surfaces, under one condition.
Unit fluid_unit(const Study& study, const Unit& contact, const Unit& film,
                const Condition& condition);

/// One row of the results. Names of scan and group belong to it: they are columns. `fluid` is null
/// where the oil does not flow.
Unit case_unit(const Study& study, const Scan& scan, const Unit& contact, const Unit& film,
               double lubricant_density, const Unit* fluid = nullptr);

/// Everything a study needs of one scan.
struct ScanUnits {
  std::string sha256;
  Unit surface;
  Unit film;
  std::vector<Unit> contacts;             ///< one per pressure
  std::vector<std::vector<Unit>> cases;   ///< [pressure][condition]
  std::vector<std::vector<Unit>> fluids;  ///< the same; empty lists where the oil does not flow
};

/// Reads every scan file once, for its digest. Throws InputError.
std::vector<ScanUnits> units_of(const Study& study, const Observer& observer = {});

/// "contact surface.x3p 7 MPa": what a person watching calls the unit.
std::string stage_name(const std::string& what, const Scan& scan, double mean_pressure = 0);

}  // namespace tabor::study
