#pragma once

#include <string_view>

namespace tabor::io {

/// Pages of a mapped file that may vanish: another program cuts the file short, a network drive
/// goes away. Touching one raises SIGBUS, which ends the program, unless it called
/// trap_lost_pages() (protection.hpp): then zeros take the place of everything from that page on
/// while its map is watched, and were_lost() says so.
class WatchedPages {
 public:
  WatchedPages() = default;
  ~WatchedPages() { forget(); }
  WatchedPages(const WatchedPages&) = delete;
  WatchedPages& operator=(const WatchedPages&) = delete;

  /// `map` begins on a page. Does nothing where 256 maps are watched already.
  void watch(std::string_view map);
  void forget();
  bool were_lost() const;

  struct Place;

 private:
  Place* place_ = nullptr;
};

}  // namespace tabor::io
