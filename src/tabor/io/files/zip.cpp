#include "tabor/io/files/zip.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <ctime>

#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

/// 1980-01-01, the earliest date a ZIP archive can hold.
constexpr std::time_t kTimeStamp = 315532800;

struct CloseFile {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using File = std::unique_ptr<zip_file_t, CloseFile>;

struct FreeSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Source = std::unique_ptr<zip_source_t, FreeSource>;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using ArchiveHandle = std::unique_ptr<zip_t, Discard>;

std::vector<ZipEntry> list(zip_t* archive) {
  std::vector<ZipEntry> entries;
  const zip_int64_t count = zip_get_num_entries(archive, 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    if (zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &stat) == 0 &&
        (stat.valid & ZIP_STAT_NAME) && (stat.valid & ZIP_STAT_SIZE)) {
      entries.push_back({stat.index, stat.name, stat.size, stat.comp_size});
    }
  }
  return entries;
}

/// Reads until the piece is full or the entry ends; -1 if it is damaged.
std::int64_t fill(zip_file_t* file, std::string& piece) {
  std::size_t size = 0;
  while (size < piece.size()) {
    const zip_int64_t n = zip_fread(file, piece.data() + size, piece.size() - size);
    if (n < 0) return -1;
    if (n == 0) break;
    size += static_cast<std::size_t>(n);
  }
  return static_cast<std::int64_t>(size);
}

}  // namespace

struct ZipReader::Archive {
  ArchiveHandle handle;
};

ZipReader::ZipReader(std::string_view bytes, std::string name) : name_(std::move(name)) {
  zip_error_t error;
  zip_error_init(&error);
  Source source(zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error));
  zip_t* opened = source ? zip_open_from_source(source.get(), ZIP_RDONLY, &error) : nullptr;
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (opened == nullptr) {
    throw InputError(name_, "a damaged or truncated ZIP archive (" + reason + ")", "",
                     "export or copy the file again");
  }
  static_cast<void>(source.release());  // the archive owns it now
  archive_ = std::make_unique<Archive>(Archive{ArchiveHandle(opened)});
  entries_ = list(opened);
}

ZipReader::~ZipReader() = default;
ZipReader::ZipReader(ZipReader&&) noexcept = default;
ZipReader& ZipReader::operator=(ZipReader&&) noexcept = default;

std::string ZipReader::read(const ZipEntry& entry, std::size_t limit) const {
  std::string content;
  read(entry, limit, [&content](std::string_view piece) { content += piece; });
  return content;
}

void ZipReader::read(const ZipEntry& entry, std::size_t limit,
                     const std::function<void(std::string_view)>& accept) const {
  const std::string what = name_ + ": " + entry.name;
  const auto check = [&](std::size_t size) {
    if (size <= limit) return;
    throw InputError(what, fmt::format("{} bytes", size), fmt::format("at most {} bytes", limit),
                     "the archive contradicts its own description");
  };
  check(entry.size);
  const File file(zip_fopen_index(archive_->handle.get(), entry.index, 0));
  if (!file && zip_error_code_zip(zip_get_error(archive_->handle.get())) == ZIP_ER_NOPASSWD) {
    throw InputError(what, "an encrypted entry", "", "unpack it with its password first");
  }
  std::string piece(std::min(kPiece, limit + 1), '\0');
  std::size_t size = 0;
  std::int64_t n = -1;
  while (file && (n = fill(file.get(), piece)) > 0) {
    size += static_cast<std::size_t>(n);
    check(size);
    accept(std::string_view(piece).substr(0, static_cast<std::size_t>(n)));
  }
  if (n != 0 || size != entry.size) {
    throw InputError(what, "an entry that cannot be unpacked", "",
                     "the file is damaged or truncated; export or copy it again");
  }
}

namespace {

[[noreturn]] void cannot_zip(const char* reason) {
  throw OutputError(std::string("cannot build a ZIP archive: ") + reason);
}

void add(zip_t* archive, const ZipContent& file) {
  Source source(zip_source_buffer(archive, file.bytes.data(), file.bytes.size(), 0));
  if (!source) cannot_zip(zip_strerror(archive));
  const zip_int64_t index =
      zip_file_add(archive, file.name.c_str(), source.get(), ZIP_FL_ENC_UTF_8);
  if (index < 0) cannot_zip(zip_strerror(archive));
  static_cast<void>(source.release());  // the archive owns it now
  zip_file_set_mtime(archive, static_cast<zip_uint64_t>(index), kTimeStamp, 0);
}

std::string content_of(zip_source_t* source) {
  zip_stat_t stat;
  if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0) {
    cannot_zip("its content was lost");
  }
  std::string bytes(stat.size, '\0');
  const zip_int64_t n = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (n < 0 || static_cast<std::size_t>(n) != bytes.size()) cannot_zip("its content was lost");
  return bytes;
}

}  // namespace

std::string zip(const std::vector<ZipContent>& files) {
  zip_error_t error;
  zip_error_init(&error);
  const Source source(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!source) cannot_zip("out of memory");
  zip_source_keep(source.get());  // one reference for the archive, one for reading it back
  ArchiveHandle archive(zip_open_from_source(source.get(), ZIP_TRUNCATE, &error));
  if (!archive) {
    zip_source_free(source.get());
    cannot_zip("out of memory");
  }
  for (const ZipContent& file : files) add(archive.get(), file);
  if (zip_close(archive.get()) != 0) cannot_zip(zip_strerror(archive.get()));
  static_cast<void>(archive.release());  // closed
  return content_of(source.get());
}

}  // namespace tabor::io
