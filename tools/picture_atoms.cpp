// SPDX-License-Identifier: MPL-2.0
#include "picture_atoms.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/ball_names.h"
#include "molsurf/molecule/selection/shown_atoms.h"
#include "molsurf/show/picture/view_file.h"

#include <algorithm>
#include <utility>

namespace molsurf::tool
{

bool isOfPlaces(const NoteText& note)
{
    return std::all_of(note.places.begin(), note.places.end(),
                       [](const std::string& place) { return bool(placeIn(place)); });
}

void addNotes(const std::vector<NoteText>& notes,
              const std::function<BallSet(const std::string& select)>& atomsOf,
              DrawOptions& picture)
{
    for (const NoteText& text : notes) {
        std::string residue;
        const auto placeOf = [&](const std::string& place) {
            if (const auto point = placeIn(place)) return *point;
            const BallSet atoms = atomsOf(place);
            const BallNames::Residue& first = atoms.names->residues[0];
            residue = first.chain + " " + first.name + " " + numberText(first);
            return middleOf(atoms);
        };
        PictureNote note{placeOf(text.places[0]), {}, text.text};
        if (text.places.size() > 1) {
            note.to = placeOf(text.places[1]);
            if (*note.to == note.from)
                throw Error(ErrorKind::Input, "--ruler " + text.places[0] + ".." + text.places[1] +
                                                  ": expected two places, got one");
        } else if (note.text.empty()) {
            note.text = residue;
        }
        picture.notes.push_back(std::move(note));
    }
}

void zoomTo(const BallSet& atoms, DrawOptions& picture)
{
    std::vector<openvdb::Vec3d> places;
    for (const Ball& ball : atoms.balls) places.emplace_back(ball.center);
    molsurf::zoomTo(std::move(places), picture);
}

void lookAt(const CommandLine& call, const BallSet& atoms, const BallSet& surface,
            DrawOptions& picture)
{
    constexpr double least = 0.1; // [Å]
    const openvdb::Vec3d way = middleOf(atoms) - middleOf(surface);
    if (way.length() < least)
        throw Error(ErrorKind::Input,
                    "--view " + call.viewed +
                        ": these atoms lie about the middle, expected some on one side [hint: "
                        "--view X,Y,Z is a direction]");
    lookFrom(way, picture);
}

} // namespace molsurf::tool
