#pragma once

#include <string_view>

namespace tabor::io {

/// Watches the pages of a mapped file, which may vanish when another program cuts the file short or
/// a network drive disappears. Reading a lost page raises SIGBUS, which ends the program, unless it
/// called trap_lost_pages() (protection.hpp): then zeros replace everything from that page on while
/// its map is watched, and were_lost() returns true.
class WatchedPages {
 public:
  WatchedPages() = default;
  ~WatchedPages() { forget(); }
  WatchedPages(const WatchedPages&) = delete;
  WatchedPages& operator=(const WatchedPages&) = delete;

  /// Watches `map`, which begins on a page. Does nothing where 256 maps are watched already.
  void watch(std::string_view map);
  void forget();
  bool were_lost() const;

  struct Place;

 private:
  Place* place_ = nullptr;
};

}  // namespace tabor::io
