// SPDX-License-Identifier: GPL-3.0-or-later
// Stage results as the records that result.json is made of. Names end in their unit.
#pragma once

#include "engine/core/record.h"
#include "engine/pipeline.h"

namespace toile {

Record quality_record(const DrapeQuality& quality);
Record drape_record(const DrapeResult& result);  // quality and diagnostics
Record fit_record(const Pattern& pattern, const FitComparison& comparison);
Record derivation_record(const DerivedPattern& derived);
Record alteration_record(const AlterPatternResult& altered);
Record place_record(const PlacedPlans& place);
Record after_record(const DrapedAlteration& after);
Record edges_record(const FitPatternEdgesResult& edges);

}  // namespace toile
