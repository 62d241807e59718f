// SPDX-License-Identifier: GPL-3.0-or-later
// toile register: the body map alone.
#include <cstdio>

#include "engine/bodies/carry_landmarks.h"
#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/measure_body.h"
#include "engine/bodies/register_bodies.h"
#include "engine/io/body_json.h"
#include "engine/io/mesh_file.h"
#include "engine/io/record_json.h"
#include "server/app/body_source.h"
#include "server/app/command.h"
#include "server/app/files.h"

namespace toile::app {
namespace {

struct RegisterArguments {
  std::string reference_body, target_body, reference_landmarks, out;
  BodySource target;
  bool find_always = false;
};

// The registered body is clean and whole: it is what a scan is measured by.
Body registered_body(const Body& reference, const Body& target, const BodyMap& map) {
  Body body;
  body.name = target.name;
  body.kind = target.kind;
  body.surface = {map.mapped, reference.surface.triangles};
  body.normalised_from_file = target.normalised_from_file;
  body.landmarks = carry_landmarks(reference.landmarks, reference.surface, map.mapped);
  if (body.kind == BodyKind::Human) {
    body.skeleton = find_skeleton(body.surface).skeleton;
    body.measurements = measure_body(body.surface, *body.skeleton, body.landmarks).measurements;
  }
  return body;
}

Record map_document(const Body& registered, const RegisterBodiesResult& result) {
  Record document;
  document.add("schema", "toile/map/1").add("exact", result.map.exact);
  for (const RecordField& field : result.diagnostics.fields()) document.add(field.name, field.value);
  const Record body = describe_body(registered);
  for (const RecordField& field : body.fields()) document.add(field.name, field.value);
  return document;
}

void run(const RegisterArguments& arguments, Context& context) {
  prepare_folder(arguments.out);
  BodySource reference_source;
  reference_source.landmarks = arguments.reference_landmarks;
  const Body reference = read_body(read_body_input(arguments.reference_body, reference_source));
  const BodyInput target_input = read_body_input(arguments.target_body, arguments.target);
  const TargetBody imported = read_target_body(target_input);
  Body target = imported.body;
  RegisterBodiesOptions options;
  options.target_landmarks = given_landmarks(target_input, target.normalised_from_file);
  require_known(target_input, options.target_landmarks, reference);
  options.use_shared_topology = !arguments.find_always;
  RegisterBodiesResult result = register_bodies(reference, imported.seen(), options, &context.progress);
  if (imported.patch_triangles > 0) stand_on_soles(target, result);
  const Body registered = registered_body(reference, target, result.map);
  const std::filesystem::path folder = arguments.out;
  write_file(folder / "mapped_reference.obj", write_obj(registered.surface));
  write_file(folder / "map.json", write_json(map_document(registered, result)));
  for (const char* name : {"mapped_reference.obj", "map.json"}) std::printf("%s\n", (folder / name).c_str());
}

}  // namespace

void add_register_command(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<RegisterArguments>();
  CLI::App* command = app.add_subcommand("register", "Find which place of one body is which place of another");
  command
      ->add_option("--reference-body", arguments->reference_body,
                   std::string("Body whose surface is carried over: ") + kBodyHelp)
      ->type_name("BODY")
      ->required();
  command->add_option("--target-body", arguments->target_body, "Body or scan it is carried to")
      ->type_name("BODY")
      ->required();
  command->add_option("--out", arguments->out, "Folder for mapped_reference.obj and map.json; made if needed")
      ->type_name("FOLDER")
      ->required();
  add_body_options(*command, arguments->target);
  command->add_option("--target-landmarks", arguments->target.landmarks, "The same as --landmarks")->type_name("FILE");
  command->add_option("--reference-landmarks", arguments->reference_landmarks, "The same for the reference body")
      ->type_name("FILE");
  command->add_flag("--find-always", arguments->find_always,
                    "Compare the shapes even where both bodies have the same vertices in the same order");
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace toile::app
