// SPDX-License-Identifier: MPL-2.0
/// @file
/// Words of the command line and of files that have a grammar. The first byte says which.

#include "input.h"

#include "molsurf/molecule/selection/choose_copies.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/structure/assembly_operators.h"
#include "molsurf/molecule/structure/readers.h"
#include "molsurf/surface/frame_source.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    static const Structure structure =
        readPdb("ATOM      1  N  AALA A   1      11.104   6.134  -6.504  0.60  1.00           N\n"
                "ATOM      2  N  BALA A   1      11.204   6.134  -6.504  0.40  2.00           N\n"
                "ATOM      3  CA  ALA A   1      11.639   6.071  -5.147  1.00 13.79           C\n"
                "ATOM      4  CB  GLY A   2A     12.639   7.071  -5.147  1.00 13.79           C\n"
                "HETATM    5 ZN    ZN B   3      21.639   6.071  -5.147  1.00 13.79          ZN\n"
                "HETATM    6  O   HOH B   4      31.639   6.071  -5.147  1.00 13.79           O\n",
                "structure", Progress());
    static const std::map<std::string, Operator> operators = [] {
        std::map<std::string, Operator> out;
        for (const char* name : {"1", "2", "3", "X0", "P"}) out[name].name = name;
        return out;
    }();
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    fuzz::expectErrorAtMost([&] {
        switch (data[0]) {
        case 's':
            matchAtoms(structure, text);
            break;
        case 'o':
            expandOperators(text, operators);
            break;
        case 'c':
            parseCopies(text);
            break;
        case 'f':
            parseFrames(text);
            break;
        case '#':
            parseColor(text);
            break;
        }
    });
    return 0;
}
