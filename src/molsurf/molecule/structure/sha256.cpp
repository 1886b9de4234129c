// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/sha256.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/molecule/structure/archive.h"
#include "molsurf/molecule/structure/load_text.h"

#include <sodium/crypto_hash_sha256.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

namespace molsurf
{

namespace
{

std::string sha256(std::istream& in, const std::string& name)
{
    crypto_hash_sha256_state state;
    crypto_hash_sha256_init(&state);
    constexpr std::size_t size = std::size_t(1) << 16;
    const std::unique_ptr<char[]> block(new char[size]);
    if (in) errno = 0;
    while (in) {
        in.read(block.get(), std::streamsize(size));
        crypto_hash_sha256_update(&state, reinterpret_cast<const unsigned char*>(block.get()),
                                  std::size_t(in.gcount()));
    }
    if (!in.eof())
        throw Error(ErrorKind::Input, "cannot read " + name + " for its SHA-256", mayPass(errno));
    unsigned char digest[crypto_hash_sha256_BYTES];
    crypto_hash_sha256_final(&state, digest);

    std::string text;
    for (const unsigned char byte : digest) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

} // namespace

std::string sha256OfFile(const std::string& path)
{
    if (readsOnce(path)) return "";
    std::ifstream file(path, std::ios_base::binary);
    return sha256(file, path);
}

std::string sha256OfText(const std::string& text)
{
    std::istringstream in(text);
    return sha256(in, "a text");
}

std::string sha256OfInput(const std::string& path, std::size_t maxBytes)
{
    std::error_code ignored;
    try {
        if (memberOf(path)) return sha256OfText(loadBytes(path, maxBytes));
        return std::filesystem::is_regular_file(path, ignored) ? sha256OfFile(path) : "";
    } catch (const Error&) {
        return "";
    }
}

} // namespace molsurf
