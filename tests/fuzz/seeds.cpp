#include "fuzz/seeds.hpp"

#include <algorithm>

#include "fuzz/archive.hpp"
#include "fuzz/png.hpp"
#include "study/example_study.hpp"
#include "support/container_files.hpp"
#include "support/exchange_files.hpp"
#include "support/folder.hpp"
#include "support/instrument_files.hpp"
#include "support/sample_map.hpp"
#include "tabor/io/image/png.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::fuzz {
namespace {

using test::Folder;

/// The small map as each of our writers stores it; formats we cannot read again are no seeds.
void add_written(std::vector<Seed>& seeds) {
  const Folder folder;
  for (const scan::FormatRow& format : scan::formats()) {
    if (!format.writes || !format.reads) continue;
    const std::filesystem::path file = folder / ("map" + format.extensions.front());
    scan::write(test::small_map(), file);
    seeds.push_back({format.name, "written", test::bytes_of(file)});
  }
}

std::string grey_png() {
  const Folder folder;
  io::write_png({3, 2, 1, {0, 1, 2, 100, 200, 255}}, folder / "a.png");
  return test::bytes_of(folder / "a.png");
}

void add_instruments(std::vector<Seed>& seeds) {
  for (const test::InstrumentFile& file : test::instrument_files()) {
    seeds.push_back({file.format, file.name, file.bytes});
  }
  seeds.push_back({"png", "grey", grey_png()});
  for (const int bits : {1, 2, 4, 8, 16}) {
    seeds.push_back({"png", std::to_string(bits) + "-bits", plain_png(bits, 0, 0)});
  }
  seeds.push_back({"png", "with-alpha", plain_png(16, 4, 0)});
  seeds.push_back({"png", "interlaced", plain_png(8, 0, 1)});
  seeds.push_back({"pgm", "binary", std::string("P5\n3 2\n65535\n\0\1\0\2\0\3\0\4\0\5\0\6", 25)});
  seeds.push_back({"pgm", "plain", "P2\n# grey\n3 2\n255\n1 2 3\n4 5 255\n"});
}

void add_containers(std::vector<Seed>& seeds) {
  const Folder folder;
  test::write_datx(folder / "a.datx");
  seeds.push_back({"datx", "datx", test::bytes_of(folder / "a.datx")});
  seeds.push_back({"plux", "plux", test::plux()});
  seeds.push_back({"plux", "two-layers", test::two_layer_plux()});
  seeds.push_back({"vk", "vk4", test::vk4()});
  seeds.push_back({"vk", "vk6", test::vk6()});
  seeds.push_back({"bcr", "bcr", test::bcr()});
  seeds.push_back({"bcr", "bcrf", test::bcrf(false)});
  seeds.push_back({"bcr", "wide", test::bcrf(true)});
  for (const int bits : {8, 16, 32}) {
    seeds.push_back({"tiff", std::to_string(bits) + "-bits", test::tiff(bits)});
  }
  seeds.push_back({"tiff", "float", test::tiff(32, 3)});
  seeds.push_back({"tiff", "missing", test::tiff(16, 1, 1, "2.0")});
}

void add_exchange(std::vector<Seed>& seeds) {
  for (const int version : {1, 2, 5}) {
    seeds.push_back({"nc", "version-" + std::to_string(version), test::netcdf(version)});
  }
  seeds.push_back({"nc", "line", test::netcdf_line()});
  seeds.push_back({"ce", "json", test::container("index.json")});
  seeds.push_back({"ce", "yaml", test::container("meta.yml")});
  seeds.push_back({"ce", "original", test::container_of_original("a.txt", "1 2\n3 4\n")});
  seeds.push_back({"mitutoyo", "profile", test::mitutoyo()});
  seeds.push_back({"opdx", "map", test::opdx()});
  seeds.push_back({"sur", "layers", test::layered_sur()});
  seeds.push_back({"stylus-text", "hfm", "X;Y;valid\n[mm];[mm];[1/0]\n0;1;1\n1;2;0\n3;2;1\n"});
  seeds.push_back({"stylus-text", "dektak", "a,b\nScan Data\n\nLateral um,Raw nm,\n0,1,\n1,2,\n"});
  seeds.push_back({"zygo-text", "points", test::zygo_points()});
  seeds.push_back({"zygo-text", "counts", test::zygo_counts()});
}

void add_texts(std::vector<Seed>& seeds) {
  const std::pair<const char*, std::string> texts[]{
      {"plain", "1.5 2 -3\n4 NaN 6\n"},
      {"commas", "# a remark\n1,5;2;-3;\n4;;6;\n"},
      {"gwyddion",
       "# Channel: Main\n# Width: 10 um\n# Height: 8000 nm\n# Value units: nm\n1 2\n3 4\n"},
      {"german", "# Kanal: Main\n# Breite: 10,0 µm\n# Höhe: 8 µm\n# Werteinheiten: nm\n1 2\n3 4\n"},
      {"wyko",
       "h= 2 w= 2 pixel size= 1.5 um data unit= nm height conversion factor= 2\n1 2\n3 4\n"},
      {"nova",
       "File Format = ASCII\nCreated by Nova\nNX = 2\nNY = 2\nScale X = 0,5\nScale Y = 0.5\n"
       "Unit X = um\nUnit Data = nm\nScale Data = 0.5\nBias Data = 1\nDataScaleNeeded = yes\n"
       "Start of Data :\n1 2\n3 4\n"},
      {"spip",
       "# File Format = ASCII\n# x-pixels = 2\n# y-pixels = 2\n# x-length = 2\n# y-length = 2\n"
       "# z-unit = [nm]\n# voidpixels =1\n# Start of Data:\n1 2\n3 4\n1 1\n0 1\n"},
      {"sections",
       "# Channel: a\n# Width: 2 um\n# Value units: nm\n1 2\n3 4\n# Channel: b\n1 2\n3 5\n"},
      {"quoted", "\"1,5\",\"2\"\n\"3\",\"4\"\n"},
      {"coordinates",
       "0 1 2 3 4 5\n1 7 3 9 2 1\n2 5 8 1 1 4\n3 4 4 1 9 0\n4 0 1 7 2 2\n5 1 2 6 6 1\n"},
      {"nanoscope", "\\Exported image units: nm\n1\n2\n3\n4\n"},
      {"utf16", std::string("\xff\xfe"
                            "1\0 \0"
                            "2\0\n\0",
                            10)},
  };
  for (const auto& [name, text] : texts) seeds.push_back({"matrix", name, text});
  const char* points = "x,y,z\n0,0,1\n5,0,2\n\n0,5,3\n5,5,NM\n";
  seeds.push_back({"xyz", "points", points});
  seeds.push_back({"xyz", "profile", "0 1\n1 2\n2 4\n3 1\n"});
}

/// The readable content of the archives among the seeds.
void add_archives(std::vector<Seed>& seeds) {
  std::vector<Seed> archives;
  for (const Seed& seed : seeds) {
    if (!seed.bytes.starts_with("PK\x03\x04")) continue;
    archives.push_back({"archive", seed.target + "-" + seed.name, unpacked(seed.bytes)});
  }
  seeds.insert(seeds.end(), archives.begin(), archives.end());
}

void add_words(std::vector<Seed>& seeds) {
  int n = 0;
  for (const char* text : {"0.45 g/m^2", "7MPa", "1.5e-8 1/Pa", "0.1 Pa s", "5 mm/s", "0.33",
                           "2MPa,7 MPa", "µm", "Å", "20 degC", "1e400 m"}) {
    seeds.push_back({"units", std::to_string(n++), text});
  }
  for (const char* text :
       {"level=plane\nfill=harmonic", "crop=1,1,3,2\nlevel=poly2", "lowpass=hann:512/L\nmirror",
        "fill=harmonic\nlowpass=gauss:2um\nhighpass=gauss:10um", "resample=8,6\nflip=x",
        "level=mean\nfill=harmonic\nresample=2,2"}) {
    seeds.push_back({"treatment", std::to_string(n++), text});
  }
  for (const topography::StepDescription& step : topography::treatment_steps()) {
    const std::string argument = step.argument.substr(0, step.argument.find('|'));
    seeds.push_back({"treatment", step.name, step.name + (argument.empty() ? "" : "=" + argument)});
  }
}

void add_tables(std::vector<Seed>& seeds) {
  seeds.push_back({"study", "example", test::kStudyText});
  const char* table =
      "mean_pressure_MPa,friction,error,lubricant_density_g_per_m2\n2,0.3,0.02,0.5\n";
  const char* cells = "# measured\nmean_pressure,friction\n\"2 MPa\",0.3\n5000 kPa,0.2\n";
  for (const char* target : {"experiment", "csv"}) {
    seeds.push_back({target, "header", table});
    seeds.push_back({target, "cells", cells});
  }
  seeds.push_back({"json", "object", "{\"a\": [1, 2.5e3, null, true, \"x\\u00b5\"], \"b\": {}}"});
}

}  // namespace

std::vector<Seed> seeds() {
  std::vector<Seed> all;
  add_written(all);
  add_instruments(all);
  add_containers(all);
  add_exchange(all);
  add_texts(all);
  add_archives(all);
  add_words(all);
  add_tables(all);
  return all;
}

}  // namespace tabor::fuzz
