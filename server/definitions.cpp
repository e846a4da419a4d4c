#include "server/definitions.h"

#include "server/wording.h"

namespace patchlight::server {

JsonValue Definitions::body(const JsonValue& instance) const {
    if (!block_ || !block_->has(instance.text()))
        instance.reject("no definition " + in_quotes(instance.text()) +
                        suggestion(instance.text(), names()));
    return block_->at(instance.text());
}

}  // namespace patchlight::server
