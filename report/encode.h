// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>

/// How bytes and text get into a page whole and harmless.
namespace exemplar {

/// A zlib stream (RFC 1950), as browsers' `DecompressionStream("deflate")` reads. The same bytes
/// for the same input (of one version of zlib).
std::string deflated(std::string_view bytes);

/// Text for HTML, inside of elements and of quoted attributes alike. Bytes that are not UTF-8 (file
/// names may hold them) become U+FFFD, and so do control characters other than tab and line feed.
std::string escapedHtml(std::string_view text);

/// JSON text made safe inside a `<script>` element: what could end it, or begin a comment there, is
/// written as JSON's own escapes, so that its value stays the same.
std::string escapedJson(std::string_view json);

}  // namespace exemplar
