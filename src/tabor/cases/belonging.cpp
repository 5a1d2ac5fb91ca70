#include "tabor/cases/belonging.hpp"

#include <fmt/format.h>

#include "tabor/core/error.hpp"
#include "tabor/topography/digest.hpp"

namespace tabor::cases {
namespace {

bool differ(std::uint64_t one, std::uint64_t other) {
  return one != 0 && other != 0 && one != other;
}

std::string shape_of(const Field& map) { return fmt::format("({}, {})", map.rows(), map.cols()); }

void require_one_shape(const Field& gap, const Field& film) {
  if (gap.size() == 0 || film.size() == 0) return;
  if (film.rows() == gap.rows() && film.cols() == gap.cols()) return;
  throw InputError("film", "shape " + shape_of(film), "that of the contact, " + shape_of(gap),
                   "rain on the surface of the contact");
}

}  // namespace

void require_one_surface(const ContactRecord& contact, const FilmRecord& film,
                         const FluidRecord* fluid, const TrappedRecord* trapped) {
  require_one_shape(contact.state.gap, film.film.thickness);
  if (differ(contact.surface, film.surface)) {
    throw InputError("film", "a film on another surface, or on this one treated in another way",
                     "one on the surface of the contact", "rain on that surface");
  }
  if (fluid != nullptr && differ(contact.surface, fluid->surface)) {
    throw InputError("flowing film", "one over another surface", "one over that of the contact",
                     "let the oil flow between the surfaces of this contact");
  }
  if (trapped != nullptr && differ(contact.surface, trapped->surface)) {
    throw InputError("trapped oil", "oil on another surface", "oil in the gap of the contact",
                     "press the oil between the surfaces of this contact");
  }
}

void require_contact_of(const topography::Topography& surface, std::uint64_t contact) {
  if (contact == 0 || contact == topography::digest_of(surface.height, surface.grid)) return;
  throw InputError("contact", "one of another surface, or of this one treated in another way",
                   "a contact of the surface it is used with", "press that surface");
}

}  // namespace tabor::cases
