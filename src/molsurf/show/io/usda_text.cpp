// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/usda_text.h"

#include "molsurf/show/color/color_map.h"

#include <cctype>
#include <fstream>

namespace molsurf
{

std::string usdaIdentifier(const std::string& name)
{
    std::string word;
    for (const char letter : name)
        word += std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
    if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0]))) word = "_" + word;
    return word;
}

std::string usdaString(const std::string& text)
{
    std::string all = "\"";
    for (const char letter : text) {
        if (letter == '"' || letter == '\\') all += '\\';
        all += letter == '\n' || letter == '\r' ? ' ' : letter;
    }
    return all + "\"";
}

std::string usdaAsset(const std::string& file)
{
    const char* mark = file.find('@') == std::string::npos ? "@" : "@@@";
    return mark + ("./" + file) + mark;
}

std::string usdaDataLine(const std::string& name, const std::string& value)
{
    return "        string " + name + " = " + usdaString(value);
}

std::string usdaData(const std::string& path, const std::string& name)
{
    constexpr int longest = 20; // lines of our own heads
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line) || line != usdaFirstLine) return "";
    const std::string begin = "        string " + name + " = \"";
    for (int n = 0; n < longest && std::getline(file, line) && line != ")"; ++n)
        if (line.size() > begin.size() && line.rfind(begin, 0) == 0 && line.back() == '"')
            return line.substr(begin.size(), line.size() - begin.size() - 1);
    return "";
}

void putUsdaMaterial(TextOutput& out, const std::string& above, const std::string& name,
                     const std::array<std::uint8_t, 3>& color, bool byVertex,
                     const std::string& indent)
{
    const std::string in = indent + "    ", path = "<" + above + "/" + name;
    out << indent << "def Material \"" << name << "\"\n"
        << indent << "{\n"
        << in << "token outputs:surface.connect = " << path << "/surface.outputs:surface>\n\n"
        << in << "def Shader \"surface\"\n"
        << in << "{\n"
        << in << "    uniform token info:id = \"UsdPreviewSurface\"\n"
        << in << "    color3f inputs:diffuseColor";
    if (byVertex) {
        out << ".connect = " << path << "/color.outputs:result>";
    } else {
        out << " = ";
        putTuple(out, linearLight(color), 3, usdaDirectionDigits);
    }
    out << "\n"
        << in << "    float inputs:roughness = 0.5\n"
        << in << "    token outputs:surface\n"
        << in << "}\n";
    if (byVertex)
        out << "\n"
            << in << "def Shader \"color\"\n"
            << in << "{\n"
            << in << "    uniform token info:id = \"UsdPrimvarReader_float3\"\n"
            << in << "    string inputs:varname = \"displayColor\"\n"
            << in << "    float3 outputs:result\n"
            << in << "}\n";
    out << indent << "}\n";
}

} // namespace molsurf
