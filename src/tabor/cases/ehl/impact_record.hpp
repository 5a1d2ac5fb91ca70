#pragma once

#include "tabor/cases/ehl/program.hpp"
#include "tabor/ehl/impact/impact.hpp"
#include "tabor/ehl/impact/measures.hpp"
#include "tabor/reference/impact.hpp"

// Makes the record of an impact: the numbers of `tabor ehl impact`.
namespace tabor::ehl {

/// What a user is told of an impact.
struct ImpactRecord {
  ImpactMeasures measures;
  ImpactGroups groups;
  reference::DryImpact dry;  ///< of the same ball without liquid
  Index nodes = 0;
};
const Columns<ImpactRecord>& impact_columns();

/// The columns of the dry impact alone, without "dry." before their keys.
const Columns<reference::DryImpact>& dry_impact_columns();

/// The record of a solved impact.
ImpactRecord impact_record(const ImpactProblem& problem, const ImpactResult& result);

/// The same for a person.
Facts facts_of(const ImpactProblem& problem, const ImpactResult& result,
               const ImpactRecord& record);

}  // namespace tabor::ehl
