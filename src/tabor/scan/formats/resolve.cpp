#include "tabor/scan/formats/resolve.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

namespace tabor::scan::format {
namespace {

bool is_length(const std::string& unit) { return unit_factor(unit, dimension::length).has_value(); }

bool is_height(const Layer& layer) { return !layer.is_picture && is_length(layer.unit); }

/// True if the layer may hold heights once the user names the unit.
bool may_be_height(const Layer& layer) {
  return !layer.is_picture && (layer.unit.empty() || is_length(layer.unit));
}

int index_of(const Document& document, const Layer& layer) {
  return layer.index.value_or(static_cast<int>(&layer - document.layers.data()));
}

/// The layers for which `suits` holds, all of them if it is null.
std::string list(const Document& document, bool (*suits)(const Layer&) = nullptr) {
  std::string text;
  for (const Layer& layer : document.layers) {
    if (suits != nullptr && !suits(layer)) continue;
    text += fmt::format("{}{} '{}' [{}]", text.empty() ? "" : ", ", index_of(document, layer),
                        layer.name, layer.unit.empty() ? "no unit" : layer.unit);
  }
  return text;
}

const Layer& named_layer(const Contents& contents, const Document& document,
                         const std::string& channel) {
  const auto number = parse_number(channel);
  const Layer* found = nullptr;
  for (const Layer& layer : document.layers) {
    if (number && index_of(document, layer) == *number) return layer;
    if (lower(layer.name) != lower(channel)) continue;
    if (found != nullptr) {
      reject(contents, "several channels named '" + channel + "': " + list(document), "one channel",
             fmt::format("give its number: <channel={}>", index_of(document, *found)));
    }
    found = &layer;
  }
  if (found == nullptr) {
    reject(contents, "no channel '" + channel + "'", "one of " + list(document),
           "give its number or name with <channel>");
  }
  return *found;
}

std::string given_as(const char* name, double metres) {
  return fmt::format("<{}={:g}um>", name, metres * 1e6);
}

/// A unit as its setting, unless what stands there is no word.
std::string given_unit(const std::string& unit) {
  const bool is_word = !unit.empty() && unit.find_first_of(" <>") == std::string::npos;
  return is_word ? "<unit=" + unit + ">" : "unit '" + unit + "'";
}

/// " (<pixel> and <override_unit> stand in tabor.toml)": what was not typed of an override.
std::string origin_of(const char* name, const ReadOptions& options) {
  std::string text;
  std::string file;
  for (const char* each : {name, "override_unit"}) {
    const auto found = options.origin.find(each);
    if (found == options.origin.end()) continue;
    text += fmt::format("{}<{}>", text.empty() ? " (" : " and ", each);
    file = found->second;
  }
  if (text.empty()) return "";
  return text + (text.find(" and ") == std::string::npos ? " stands" : " stand") + " in " + file +
         ")";
}

/// What a header says that no pixel can be, and who says it.
std::string impossible(double length, char axis, const std::string& said) {
  return fmt::format("a pixel of {:g} m along {}{}", length, axis,
                     said.empty() ? "" : " (" + said + ")");
}

/// The pixel along one axis of a file that states what none can be.
double resolve_impossible(const Contents& contents, const std::string& got,
                          const std::optional<double>& given, const ReadOptions& options,
                          std::vector<std::string>& warnings) {
  if (given && options.override_unit) {
    warnings.push_back(fmt::format("pixel overridden: {:g} um instead of {}{}", *given * 1e6, got,
                                   origin_of("pixel", options)));
    return *given;
  }
  reject(contents, got, "a positive length, from 1e-15 to 1e6 m",
         given ? "add <override_unit>, so that <pixel> wins over the file"
               : "export the file again, or give the pixel, for example <pixel=0.67um> "
                 "<override_unit>");
}

/// The pixel along one axis.
double resolve_pixel(const Contents& contents, const Layer& layer, char axis,
                     const std::optional<double>& given, const ReadOptions& options,
                     std::vector<std::string>& warnings) {
  const std::optional<double>& own = axis == 'x' ? layer.pixel_x : layer.pixel_y;
  if (!own && !given) {
    ask(contents, layer.pixel_hint.empty() ? "no pixel size in the file" : layer.pixel_hint,
        "a pixel size",
        std::string("add it, for example <pixel=0.67um>") +
            (layer.unit.empty() && !layer.is_count ? " <unit=um>" : ""));
  }
  if (given && !is_pixel(*given)) {
    reject(contents, given_as("pixel", *given), "a positive length, from 1e-15 to 1e6 m");
  }
  if (own && !is_pixel(*own)) {
    const std::string& said = axis == 'x' ? layer.said_x : layer.said_y;
    return resolve_impossible(contents, impossible(*own, axis, said), given, options, warnings);
  }
  if (!given) return *own;
  constexpr double kSame = 1e-6;  // what a user types has fewer digits than the file
  if (!own) return *given;
  if (std::abs(*given - *own) <= kSame * *own) return *own;
  if (!options.override_unit) {
    reject(contents, given_as("pixel", *given),
           fmt::format("{:g} um along {}, which the file fixes", *own * 1e6, axis),
           "drop <pixel>; add <override_unit> if the file is wrong");
  }
  warnings.push_back(
      fmt::format("pixel along {} overridden: {:g} um instead of the file's {:g} um{}", axis,
                  *given * 1e6, *own * 1e6, origin_of("pixel", options)));
  return *given;
}

double factor_of_unit(const Contents& contents, const std::string& unit) {
  const auto factor = unit_factor(unit, dimension::length);
  if (!factor) reject(contents, given_unit(unit), "a length such as um or nm");
  return *factor;
}

/// A count has no size of its own: only the user's <z_scale> gives it one.
double scale_of_counts(const Contents& contents, const ReadOptions& options) {
  if (!options.z_scale) {
    ask(contents, "counts without a height scale", "the height of one count",
        "add it, for example <z_scale=1nm>");
  }
  if (!(std::abs(*options.z_scale) > 0) || !std::isfinite(*options.z_scale)) {
    reject(contents, given_as("z_scale", *options.z_scale), "a length other than zero");
  }
  return *options.z_scale;
}

}  // namespace

std::vector<Channel> channels_of(const Document& document) {
  std::vector<Channel> channels;
  for (const Layer& layer : document.layers) {
    channels.push_back({.index = index_of(document, layer),
                        .name = layer.name,
                        .unit = layer.unit,
                        .is_height = is_height(layer),
                        .nx = layer.nx,
                        .ny = layer.ny});
  }
  return channels;
}

const Layer& choose_layer(const Contents& contents, const Document& document,
                          const ReadOptions& options) {
  if (options.channel) return named_layer(contents, document, *options.channel);
  for (bool (*const suits)(const Layer&) : {&is_height, &may_be_height}) {
    const Layer* only = nullptr;
    int count = 0;
    for (const Layer& layer : document.layers) {
      if (!suits(layer)) continue;
      if (count++ == 0) only = &layer;
    }
    if (count == 1) return *only;
    if (count > 1) {
      ask(contents, fmt::format("{} height channels: {}", count, list(document, suits)), "one",
          fmt::format("choose it, for example <channel={}>", index_of(document, *only)));
    }
  }
  ask(contents, "no channel whose unit is a length: " + list(document), "heights",
      "choose one with <channel> and <unit=um> <override_unit> if it does hold heights");
}

Grid resolve_grid(const Contents& contents, const Layer& layer, const ReadOptions& options,
                  std::vector<std::string>& warnings) {
  const double dx = resolve_pixel(contents, layer, 'x', options.pixel_x, options, warnings);
  const bool has_ratio = layer.pixel_ratio && options.pixel_x && !layer.pixel_y;
  const double ratio = has_ratio ? *layer.pixel_ratio : 1;
  const auto given_y = options.pixel_y   ? options.pixel_y
                       : options.pixel_x ? std::optional(ratio * *options.pixel_x)
                                         : std::nullopt;
  constexpr double same_ratio = 1e-3;
  if (has_ratio && std::abs(*given_y / *options.pixel_x - ratio) > same_ratio * ratio &&
      !options.override_unit) {
    reject(contents, fmt::format("pixels {:g} times as high as wide", *given_y / *options.pixel_x),
           fmt::format("{:g} times, as the coordinates have them", ratio),
           "give the pixel along x only, or add <override_unit>");
  }
  const double dy = resolve_pixel(contents, layer, 'y', given_y, options, warnings);
  return {.nx = layer.nx,
          .ny = layer.ny,
          .lx = dx * static_cast<double>(layer.nx),
          .ly = dy * static_cast<double>(layer.ny)};
}

double resolve_height_factor(const Contents& contents, const Layer& layer,
                             const ReadOptions& options, std::vector<std::string>& warnings) {
  const bool is_fixed = !layer.is_count && !layer.unit.empty();
  if (options.z_scale && is_fixed && !options.override_unit) {
    reject(contents, given_as("z_scale", *options.z_scale), "heights whose scale the file fixes",
           "drop <z_scale>; add <override_unit> if the file is wrong");
  }
  if (options.z_scale) {
    if (is_fixed) {
      warnings.push_back("height scale overridden: " + given_as("z_scale", *options.z_scale) +
                         origin_of("z_scale", options));
    }
    return scale_of_counts(contents, options);
  }
  if (layer.unit.empty() && layer.is_count && !options.unit) {
    return scale_of_counts(contents, options);
  }
  const auto own = unit_factor(layer.unit, dimension::length);
  if (options.unit && (!own || factor_of_unit(contents, *options.unit) != *own)) {
    const double given = factor_of_unit(contents, *options.unit);
    if (layer.unit.empty()) return layer.scale * given;
    if (!options.override_unit) {
      reject(contents, given_unit(*options.unit), "'" + layer.unit + "', which the file fixes",
             "drop <unit>; add <override_unit> if the file is wrong");
    }
    warnings.push_back("height unit overridden: " + *options.unit + " instead of the file's '" +
                       layer.unit + "'" + origin_of("unit", options));
    return layer.scale * given;
  }
  if (own) return layer.scale * *own;
  if (layer.unit.empty()) {
    ask(contents, "heights without a unit", "a unit", "add it, for example <unit=um>");
  }
  reject(contents, "channel '" + layer.name + "' in '" + layer.unit + "'", "heights",
         "choose another <channel>, or give <unit> with <override_unit> if the file is wrong");
}

}  // namespace tabor::scan::format
