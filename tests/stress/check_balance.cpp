// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "tests/stress/independent.h"
#include "tests/stress/part_scenes.h"

namespace toile::stress {
namespace {

constexpr double kCrumbs = 0.01;  // of the area: openings below 0.2 cm2 are not made

double area_of(const std::vector<AlteredRegion>& regions, Outcome& outcome) {
  double sum = 0.0;
  for (const AlteredRegion& region : regions) {
    double area = polygon_area(region.shape.outline);
    for (const auto& hole : region.shape.holes) area -= std::abs(polygon_area(hole));
    if (!(std::abs(region.area - area) <= 1e-9))
      outcome.fail(print_text("area of %s: told %.9g, found %.9g", region.name.c_str(), region.area, area));
    sum += area;
  }
  return sum;
}

// Whether the ticket has the whole panel cut from new cloth: then all that was there goes.
bool cut_anew(const AlterPatternResult& altered, const std::string& panel) {
  for (const TicketOperation& operation : altered.ticket.operations)
    for (const TicketSide& side : operation.sides)
      if (operation.kind == OperationKind::CutAnew && side.panel == panel) return true;
  return false;
}

}  // namespace

void check_balance(const AlterPatternResult& altered, double stretch_limit, Outcome& outcome) {
  const bool told = !altered.flags.empty() || !altered.sewn.flags.empty();
  constexpr double kCm2 = kCmPerMetre * kCmPerMetre;
  double balance = 0.0, target = 0.0;
  for (const PanelAlteration& panel : altered.panels) {
    const double original = polygon_area(panel.original), wanted = polygon_area(panel.target),
                 in = cut_anew(altered, panel.panel) ? wanted : area_of(panel.insertions, outcome),
                 out = cut_anew(altered, panel.panel) ? original : area_of(panel.removals, outcome) + panel.cut_back;
    balance += original + in - out - wanted;
    target += wanted;
    if (!(std::abs(original + in - out - wanted) <= (2 * stretch_limit + kCrumbs) * wanted + 1e-4) && !told)
      outcome.fail(print_text("panel %s of %.1f cm2, %.1f put in, %.1f taken away, shall have %.1f; nobody is told",
                              panel.panel.c_str(), original * kCm2, in * kCm2, out * kCm2, wanted * kCm2));
  }
  if (!(target > 0)) return outcome.fail("the target pattern has no area");
  if (!(std::abs(altered.area_imbalance - std::abs(balance) / target) <= 1e-6))
    outcome.fail(
        print_text("area imbalance: told %.9g, found %.9g", altered.area_imbalance, std::abs(balance) / target));
}

}  // namespace toile::stress
