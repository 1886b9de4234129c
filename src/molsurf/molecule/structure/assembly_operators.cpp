// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/assembly_operators.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cstdint>

namespace molsurf
{
namespace
{

using std::string_view;

[[noreturn]] void failToParse(const std::string& expression, const std::string& what)
{
    throw Error(ErrorKind::Input, "operator expression " + inQuotes(expression) + ": " + what);
}

/// "1,2,5-9" -> names; a range needs integers at both ends, other dashes belong to the name.
std::vector<std::string> parseList(string_view list, const std::string& expression)
{
    std::vector<std::string> names;
    while (true) {
        const std::size_t comma = list.find(',');
        const string_view item = trimmed(list.substr(0, comma));
        if (item.empty()) failToParse(expression, "expected an operator's name, got nothing");
        const std::size_t dash = item.find('-', 1);
        int first = 0, last = 0;
        if (dash != string_view::npos && parseInteger(trimmed(item.substr(0, dash)), first) &&
            parseInteger(trimmed(item.substr(dash + 1)), last)) {
            if (last < first || std::int64_t(last) - first >= std::int64_t(maxOperators)) {
                failToParse(expression, "expected a range that ascends, got " + inQuotes(item));
            }
            for (int i = first; i <= last; ++i) names.push_back(std::to_string(i));
        } else {
            names.emplace_back(item);
        }
        if (names.size() > maxOperators)
            failToParse(expression,
                        "lists more than " + std::to_string(maxOperators) + " operators");
        if (comma == string_view::npos) return names;
        list.remove_prefix(comma + 1);
    }
}

/// One assembly that REMARK 350 describes line by line.
class Remark350
{
public:
    void add(string_view line)
    {
        const string_view body = line.size() > 10 ? line.substr(10) : string_view();
        const std::size_t colon = body.find(':');
        const string_view value = colon == string_view::npos ? "" : body.substr(colon + 1);
        if (body.find("BIOMOLECULE:") != string_view::npos) {
            assemblies_.push_back({std::string(trimmed(value)), {}, {}});
        } else if (body.find("APPLY THE FOLLOWING TO CHAINS:") != string_view::npos) {
            current().parts.push_back({});
            addChains(value);
        } else if (body.find("AND CHAINS:") != string_view::npos) {
            addChains(value);
        } else if (trimmed(body).substr(0, 5) == "BIOMT") {
            addRow(trimmed(body));
        }
    }

    std::vector<Assembly> take();

private:
    Assembly& current()
    {
        if (assemblies_.empty()) assemblies_.push_back({"1", {}, {}});
        return assemblies_.back();
    }

    AssemblyPart& part()
    {
        if (current().parts.empty()) current().parts.push_back({});
        return current().parts.back();
    }

    void addChains(string_view list)
    {
        for (const string_view name : splitNames(list)) {
            part().chains.emplace_back(name == "NULL" ? "" : name);
        }
    }

    void addRow(string_view text);

    std::vector<Assembly> assemblies_;
    Operator operator_{};
};

void Remark350::addRow(string_view text)
{
    const Fields fields = splitFields(text);
    std::array<double, 4> row{};
    const int index = text.size() > 5 ? text[5] - '1' : -1;
    bool good = fields.size() >= 6 && index >= 0 && index < 3;
    for (std::size_t i = 0; good && i < 4; ++i) good = parseNumber(fields[i + 2], row[i]);
    if (!good) {
        current().problem = "expected BIOMTn, a number and four figures, got " + inQuotes(text);
        return;
    }
    operator_.rotation[std::size_t(index)] = {row[0], row[1], row[2]};
    operator_.translation[index] = row[3];
    operator_.name = fields[1];
    if (index == 2) part().operators.push_back(operator_);
}

std::vector<Assembly> Remark350::take()
{
    for (Assembly& assembly : assemblies_) {
        auto& parts = assembly.parts;
        parts.erase(std::remove_if(parts.begin(), parts.end(),
                                   [](const AssemblyPart& p) { return p.operators.empty(); }),
                    parts.end());
        if (parts.empty() && assembly.problem.empty()) assembly.problem = "it has no operators";
    }
    return std::move(assemblies_);
}

} // namespace

Operator multiplied(const Operator& first, const Operator& second)
{
    auto factor = [](const std::string& name) {
        return name.empty() || name[0] == '(' ? name : "(" + name + ")";
    };
    return {first.after(second), factor(first.name) + factor(second.name)};
}

std::vector<std::vector<std::string>> parseOperatorExpression(const std::string& expression)
{
    std::vector<std::vector<std::string>> factors;
    string_view rest = trimmed(expression);
    if (rest.empty() || rest.front() != '(') return {parseList(rest, expression)};
    while (!rest.empty()) {
        const std::size_t close = rest.find(')');
        if (rest.front() != '(' || close == string_view::npos) {
            failToParse(expression, "expected factors in parentheses, got " + inQuotes(rest));
        }
        factors.push_back(parseList(rest.substr(1, close - 1), expression));
        rest = trimmed(rest.substr(close + 1));
    }
    return factors;
}

std::vector<Operator> expandOperators(const std::string& expression,
                                      const std::map<std::string, Operator>& operators)
{
    const auto factors = parseOperatorExpression(expression);
    std::size_t count = 1;
    for (const auto& factor : factors) {
        count *= factor.size();
        if (count > maxOperators)
            failToParse(expression, "has more than " + std::to_string(maxOperators) + " products");
    }
    std::vector<Operator> products;
    for (const auto& factor : factors) {
        std::vector<Operator> next;
        for (std::size_t i = 0; i < std::max<std::size_t>(products.size(), 1); ++i) {
            for (const std::string& name : factor) {
                const auto found = operators.find(name);
                if (found == operators.end()) {
                    failToParse(expression, "operator " + inQuotes(name) + " is not listed");
                }
                next.push_back(products.empty() ? found->second
                                                : multiplied(products[i], found->second));
            }
        }
        products = std::move(next);
    }
    return products;
}

std::vector<string_view> splitNames(string_view list)
{
    std::vector<string_view> names;
    while (!list.empty()) {
        const std::size_t comma = list.find(',');
        const string_view name = trimmed(list.substr(0, comma));
        if (!name.empty()) names.push_back(name);
        if (comma == string_view::npos) break;
        list.remove_prefix(comma + 1);
    }
    return names;
}

std::optional<Assembly> parseMtrix(const std::vector<string_view>& records,
                                   std::vector<std::string>& warnings)
{
    constexpr std::size_t serialBegin = 7, serialWidth = 3, given = 59;
    constexpr std::array<std::size_t, 4> begin{10, 20, 30, 45}; // F10.6, at the end F10.5
    Operator op{};
    std::vector<Operator> operators;
    for (const string_view line : records) {
        std::array<double, 4> row{};
        const int index = line.size() > 5 ? line[5] - '1' : -1;
        bool good = index >= 0 && index < 3;
        for (std::size_t i = 0; good && i < 4; ++i) {
            good =
                begin[i] < line.size() && parseNumber(trimmed(line.substr(begin[i], 10)), row[i]);
        }
        if (!good) {
            warnings.push_back("the MTRIX records were ignored: expected MTRIXn, a number and four "
                               "figures, got " +
                               inQuotes(line));
            return std::nullopt;
        }
        op.rotation[std::size_t(index)] = {row[0], row[1], row[2]};
        op.translation[index] = row[3];
        op.name = trimmed(line.substr(serialBegin, serialWidth));
        if (index == 2 && (line.size() <= given || line[given] != '1')) operators.push_back(op);
    }
    return ncsAssembly(std::move(operators));
}

std::optional<Assembly> ncsAssembly(std::vector<Operator> operators)
{
    if (operators.empty()) return std::nullopt;
    operators.insert(operators.begin(), {Motion::identity(), "given"});
    return Assembly{"ncs", {{{}, std::move(operators)}}, {}};
}

std::vector<Assembly> parseRemark350(const std::vector<string_view>& remarks)
{
    Remark350 reader;
    for (const string_view line : remarks) reader.add(line);
    return reader.take();
}

} // namespace molsurf
