// SPDX-License-Identifier: MPL-2.0
#include "sha256.h"

#include "molsurf/core/error.h"

#include <openssl/evp.h>

#include <fstream>
#include <memory>
#include <vector>

namespace molsurf::tool
{

std::string sha256OfFile(const std::string& path)
{
    std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    std::ifstream file(path, std::ios_base::binary);
    std::vector<char> block(std::size_t(1) << 18);
    bool good = file && context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
    while (good && file) {
        file.read(block.data(), std::streamsize(block.size()));
        good = EVP_DigestUpdate(context.get(), block.data(), std::size_t(file.gcount()));
    }
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int size = 0;
    good = good && file.eof() && EVP_DigestFinal_ex(context.get(), digest, &size);
    if (!good) throw Error(ErrorKind::Input, "cannot read " + path + " for its SHA-256");

    std::string text;
    for (unsigned int i = 0; i < size; ++i) {
        text += "0123456789abcdef"[digest[i] >> 4];
        text += "0123456789abcdef"[digest[i] & 15];
    }
    return text;
}

} // namespace molsurf::tool
