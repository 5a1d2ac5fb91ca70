#pragma once

#include <cstdint>

#include "tabor/cases/records.hpp"
#include "tabor/topography/topography.hpp"

// Checks that a contact, a film and a flow belong to one surface: same heights, same grid, same
// treatment. A record whose surface is not known (its digest is 0) is accepted by its shape.
namespace tabor::cases {

/// Throws InputError unless the film, and the flowing film (null: none), lies on the surface of the
/// contact.
void require_one_surface(const ContactRecord& contact, const FilmRecord& film,
                         const FluidRecord* fluid = nullptr,
                         const TrappedRecord* trapped = nullptr);

/// Throws InputError unless `contact`, the digest of a contact's surface, is that of `surface`.
void require_contact_of(const topography::Topography& surface, std::uint64_t contact);

}  // namespace tabor::cases
