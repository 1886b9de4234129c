// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/sha256.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/molecule/structure/archive.h"
#include "molsurf/molecule/structure/load_text.h"

#include <openssl/evp.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <vector>

namespace molsurf
{

namespace
{

std::string sha256(std::istream& in, const std::string& name)
{
    std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    std::vector<char> block(std::size_t(1) << 18);
    if (in) errno = 0;
    bool good = in && context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
    while (good && in) {
        in.read(block.data(), std::streamsize(block.size()));
        good = EVP_DigestUpdate(context.get(), block.data(), std::size_t(in.gcount()));
    }
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int size = 0;
    good = good && in.eof() && EVP_DigestFinal_ex(context.get(), digest, &size);
    if (!good)
        throw Error(ErrorKind::Input, "cannot read " + name + " for its SHA-256", mayPass(errno));

    std::string text;
    for (unsigned int i = 0; i < size; ++i) {
        text += "0123456789abcdef"[digest[i] >> 4];
        text += "0123456789abcdef"[digest[i] & 15];
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
