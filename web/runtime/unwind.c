// What WebAssembly's exceptions leave for an unwinder to do: the names are those of the C++ ABI for
// WebAssembly, which libc++abi and the compiler's landing pads call. Stacks are unwound by the
// engine.
#include <stdint.h>
#include <unwind.h>

typedef struct _Unwind_Exception Exception;
typedef struct _Unwind_Context Context;

_Unwind_Reason_Code __gxx_personality_wasm0(int version, _Unwind_Action actions, uint64_t kind,
                                            Exception* exception, Context* context);

// A landing pad fills in the first two, and reads which of its handlers is the right one.
struct LandingPad {
  uintptr_t index;
  uintptr_t language_data;
  uintptr_t selector;
};
struct LandingPad __wasm_lpad_context;

static struct LandingPad* pad_of(Context* context) { return (struct LandingPad*)context; }

_Unwind_Reason_Code _Unwind_CallPersonality(void* thrown) {
  Exception* const exception = thrown;
  __wasm_lpad_context.selector = 0;
  // libc++abi finds a handler in this phase; there is no other one.
  return __gxx_personality_wasm0(1, _UA_CLEANUP_PHASE, exception->exception_class, exception,
                                 (Context*)&__wasm_lpad_context);
}

_Unwind_Reason_Code _Unwind_RaiseException(Exception* exception) {
  __builtin_wasm_throw(0, exception);
}

void _Unwind_DeleteException(Exception* exception) {
  if (exception->exception_cleanup != 0) {
    exception->exception_cleanup(_URC_FOREIGN_EXCEPTION_CAUGHT, exception);
  }
}

uintptr_t _Unwind_GetLanguageSpecificData(Context* context) {
  return pad_of(context)->language_data;
}
uintptr_t _Unwind_GetRegionStart(Context* context) {
  (void)context;
  return 0;
}
// libc++abi takes off one, and counts pads from one.
uintptr_t _Unwind_GetIP(Context* context) { return pad_of(context)->index + 2; }
void _Unwind_SetIP(Context* context, uintptr_t value) {
  (void)context;
  (void)value;
}
uintptr_t _Unwind_GetGR(Context* context, int number) {
  (void)context;
  (void)number;
  return 0;
}
void _Unwind_SetGR(Context* context, int number, uintptr_t value) {
  if (number == 1) { // the register of the selector
    pad_of(context)->selector = value;
  }
}
