#pragma once

#include <string>
#include <vector>

/// Tiny scan files of formats that tabor only reads, made byte by byte from their published
/// layouts: 3 x 2 pixels of 2 um x 4 um with the stored values 1 2 3 / 4 5 hole (nms: 1 to 6, no
/// hole; metropro: square pixels).
namespace tabor::test {

/// A Digital Surf header with its comment and private bytes, without data. `type`: kind of
/// studiable.
std::string sur(const std::string& magic, int bits, int type = 2);
std::string plain_sur();
std::string compressed_sur();
std::string al3d();
std::string opd();
std::string plu();
std::string metropro();
std::string nms();
std::string tmd();

struct InstrumentFile {
  std::string format;  ///< its name in the format table
  std::string name;
  std::string bytes;
};

/// All of them, for tests of what must hold for every reader.
std::vector<InstrumentFile> instrument_files();

}  // namespace tabor::test
