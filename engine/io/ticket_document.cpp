// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/ticket_document.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "engine/io/text_format.h"

namespace toile {
namespace {

constexpr double kSquareCmPerSquareMetre = 1e4;

double tenth(double value) {
  return std::round(10.0 * value) / 10.0;
}
double mm(double metres) {
  return tenth(metres * kMmPerMetre);
}
double square_cm(double square_metres) {
  return tenth(square_metres * kSquareCmPerSquareMetre);
}

std::string mm_text(double metres) {
  std::string text = number(mm(metres), 1);
  text += " mm";
  return text;
}

Record side_record(const TicketSide& side) {
  std::vector<std::int64_t> edges(side.edges.begin(), side.edges.end());
  Record record;
  record.add("panel", side.panel)
      .add("edges", std::move(edges))
      .add("words", side.words)
      .add("per_ply_mm", mm(side.amount));
  return record;
}

Record piece_record(const TicketPiece& piece) {
  Record record;
  record.add("name", piece.name).add("label", piece.label).add("quantity", piece.quantity);
  record.add("width_mm", mm(piece.width)).add("length_mm", mm(piece.length)).add("area_cm2", square_cm(piece.area));
  record.add("grain_deg", tenth(piece.grain_angle * kDegreePerRadian))
      .add("seam_allowance_mm", mm(piece.seam_allowance));
  return record;
}

Record operation_record(const TicketOperation& operation, int order) {
  std::vector<Record> sides, pieces;
  for (const TicketSide& side : operation.sides) sides.push_back(side_record(side));
  for (const TicketPiece& piece : operation.pieces) pieces.push_back(piece_record(piece));
  std::vector<double> amounts;
  for (const double amount : operation.profile.amounts) amounts.push_back(mm(amount));
  Record profile, allowance;
  profile.add("spacing_mm", mm(operation.profile.spacing)).add("per_ply_mm", std::move(amounts));
  allowance.add("available_mm", mm(operation.allowance.available))
      .add("needed_mm", mm(operation.allowance.needed))
      .add("left_mm", mm(operation.allowance.left));
  Record record;
  record.add("order", order).add("op", std::string(operation_name(operation.kind))).add("where", operation.where);
  record.add("sides", std::move(sides)).add("per_ply_mm", mm(operation.per_ply)).add("total_mm", mm(operation.total));
  record.add("largest_at", operation.largest_at).add("tapers_to", operation.tapers_to);
  record.add("taper_length_mm", mm(operation.taper_length)).add("least_mm", mm(operation.least));
  record.add("least_at", operation.least_at).add("with_step", operation.with_step).add("profile", std::move(profile));
  record.add("seam_allowance", std::move(allowance)).add("fabric", std::string(fabric_need_name(operation.fabric)));
  record.add("pieces", std::move(pieces)).add("removed_area_cm2", square_cm(operation.removed_area));
  record.add("touches", operation.touches).add("below_accuracy", operation.below_accuracy);
  record.add("sentence", operation.sentence);
  return record;
}

bool adds_cloth(OperationKind kind) {
  return kind == OperationKind::LetOut || kind == OperationKind::Lengthen || kind == OperationKind::InsertStrip ||
         kind == OperationKind::InsertGusset || kind == OperationKind::InsertGodet || kind == OperationKind::CutAnew;
}

// The amount along the seam as a small graph: a filled line over the seam's length.
std::string profile_graph(const TicketProfile& profile) {
  if (profile.amounts.size() < 2) return {};
  const double most = std::max(1e-6, *std::max_element(profile.amounts.begin(), profile.amounts.end()));
  const double width = 300, height = 56, left = 4, bottom = 60,
               step = width / static_cast<double>(profile.amounts.size() - 1);
  std::string line;
  for (std::size_t i = 0; i < profile.amounts.size(); ++i)
    append(line, {"L", number(left + step * static_cast<double>(i), 1), " ",
                  number(bottom - height * profile.amounts[i] / most, 1)});
  const double length = profile.spacing * static_cast<double>(profile.amounts.size() - 1);
  std::string svg = "<svg class=\"profile\" viewBox=\"0 0 380 78\" role=\"img\" aria-label=\"amount along the seam\">";
  append(svg, {"<path d=\"M4 60", line,
               "L304 60Z\" fill=\"#dfe6fb\"/><path d=\"M4 60H304M4 4V60\" stroke=\"#6b6b75\" fill=\"none\"/>",
               "<text x=\"309\" y=\"12\" font-size=\"11\">", mm_text(most),
               "</text><text x=\"309\" y=\"62\" font-size=\"11\">0</text>",
               "<text x=\"4\" y=\"75\" font-size=\"11\">start</text><text x=\"304\" y=\"75\" font-size=\"11\" "
               "text-anchor=\"end\">",
               mm_text(length), "</text></svg>\n"});
  return svg;
}

void add_fact(std::string& list, std::string_view name, std::string_view value) {
  if (!value.empty()) append(list, {"<dt>", name, "</dt><dd>", escape_xml(value), "</dd>"});
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) append(text, {text.empty() ? "" : ", ", word});
  return text;
}

std::string sides_text(const TicketOperation& operation) {
  std::vector<std::string> words;
  for (const TicketSide& side : operation.sides) {
    std::string text = side.panel;
    text += side.edges.size() == 1 ? ", edge" : ", edges";
    for (const int edge : side.edges) append(text, {" ", std::to_string(edge)});
    if (side.amount > 0) append(text, {": ", mm_text(side.amount)});
    words.push_back(text);
  }
  std::string text;
  for (const std::string& word : words) append(text, {text.empty() ? "" : "; ", word});
  return text;
}

std::string facts(const TicketOperation& operation) {
  std::string list = "<dl>";
  add_fact(list, "where", operation.where);
  add_fact(list, "panels", sides_text(operation));
  if (operation.per_ply > 0) {
    std::string amount = mm_text(operation.per_ply);
    if (operation.total > 1.001 * operation.per_ply)
      append(amount, {" per ply, ", mm_text(operation.total), " in all"});
    add_fact(list, "amount", amount);
  }
  if (operation.allowance.needed > 0) {
    const bool enough = operation.allowance.left >= 0;
    std::string text = mm_text(operation.allowance.available);
    append(text, {" available, ", mm_text(operation.allowance.needed), " needed, ",
                  mm_text(std::abs(operation.allowance.left)), enough ? " left" : " short"});
    add_fact(list, "seam allowance", text);
  }
  if (operation.removed_area > 0) {
    std::string text = number(square_cm(operation.removed_area), 1);
    add_fact(list, "cloth removed", text += " cm\xC2\xB2");
  }
  add_fact(list, "take care of", joined(operation.touches));
  return list += "</dl>\n";
}

void add_operation(const TicketOperation& operation, int order, HtmlPage& page) {
  std::string item = adds_cloth(operation.kind) ? "<li class=\"adds\">" : "<li class=\"takes\">";
  append(item, {"<div class=\"step\"><span class=\"box\"></span><span>", std::to_string(order), ". ",
                escape_xml(operation.sentence), "</span></div>\n<p>"});
  if (operation.fabric == FabricNeed::NeedsFabric) item += "<span class=\"tag warn\">needs new fabric</span> ";
  if (operation.fabric == FabricNeed::WithinAllowance) item += "<span class=\"tag\">within the seam allowance</span> ";
  if (operation.below_accuracy) item += "<span class=\"tag\">smaller than a body can be measured to</span>";
  append(item, {"</p>\n", facts(operation), profile_graph(operation.profile), "</li>\n"});
  page.raw(item);
}

HtmlTable pieces_table(const Ticket& ticket) {
  HtmlTable table{"Pieces to cut", {"piece", "cut", "width", "length", "area", "grain", "seam allowance"}, {}};
  for (const TicketOperation& operation : ticket.operations)
    for (const TicketPiece& piece : operation.pieces) {
      std::string area = number(square_cm(piece.area), 1),
                  grain = number(tenth(piece.grain_angle * kDegreePerRadian), 1), name = piece.name;
      if (piece.label != piece.name) append(name, {" (", piece.label, ")"});
      table.rows.push_back({std::move(name), std::to_string(piece.quantity), mm_text(piece.width),
                            mm_text(piece.length), area += " cm\xC2\xB2", grain += "\xC2\xB0",
                            mm_text(piece.seam_allowance)});
    }
  return table;
}

}  // namespace

Record ticket_record(const Ticket& ticket) {
  std::vector<Record> operations;
  for (std::size_t i = 0; i < ticket.operations.size(); ++i)
    operations.push_back(operation_record(ticket.operations[i], static_cast<int>(i) + 1));
  Record record;
  record.add("schema", "toile/ticket/1").add("garment", ticket.garment);
  record.add("reference_body", ticket.reference_body).add("target_body", ticket.target_body);
  record.add("operations", std::move(operations)).add("notes", ticket.notes);
  return record;
}

void add_ticket(const Ticket& ticket, HtmlPage& page) {
  if (ticket.operations.empty()) page.paragraph("Nothing to alter: the garment fits as it is.", "note");
  page.raw("<ol class=\"work\">\n");
  for (std::size_t i = 0; i < ticket.operations.size(); ++i)
    add_operation(ticket.operations[i], static_cast<int>(i) + 1, page);
  page.raw("</ol>\n");
  const HtmlTable pieces = pieces_table(ticket);
  if (!pieces.rows.empty()) page.table(pieces);
  page.list(ticket.notes);
}

Bytes write_ticket_html(const Ticket& ticket, const Bytes& pattern_svg, std::string_view date) {
  std::string subtitle = "from ";
  append(subtitle, {ticket.reference_body, " to ", ticket.target_body, date.empty() ? "" : ", ", date});
  std::string title = "Work order: ";
  HtmlPage page(title += ticket.garment, subtitle);
  add_ticket(ticket, page);
  if (!pattern_svg.empty()) {
    page.heading("Pattern");
    page.raw("<div class=\"wide\">");
    page.raw({reinterpret_cast<const char*>(pattern_svg.data()), pattern_svg.size()});
    page.raw("</div>\n");
  }
  return page.finish();
}

}  // namespace toile
