#pragma once
// What `brisance describe` tells of shapes, of the edges of gas and of the materials that come with the program.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brisance::simulator {

/// The value of a key `shape` with this form, as an example in two dimensions: `{ box = {...} }`.
std::string_view example_of_shape(std::string_view form);

/// A form of shapes: its keys and an example. Nothing if there is no such form.
std::optional<std::string> describe_shape(std::string_view form);

/// The keys that each kind of edge of the gas takes.
std::string describe_edges();

/// What formulas may speak of, where they may stand, examples; for "formula".
std::optional<std::string> describe_formula(std::string_view name);

/// A material that comes with the program, by the name of its file with or without .toml: name, notes, laws, how to use it.
std::optional<std::string> describe_material(std::string_view name);

/// A case that comes with the program, by the name of its file with or without .toml: title, how to run it, where it is.
std::optional<std::string> describe_case(std::string_view name);

/// The names that describe_material knows.
std::vector<std::string> material_names();

}  // namespace brisance::simulator
