"""Compilation with Numba in a quarter of its usual time.

Numba normally optimises each function separately, and again within each function that calls it.
Here, functions called only by compiled code (parts) are translated without optimisation. A function
called from Python is optimised once, together with all parts that it calls. Named tuples are passed
by address instead of field by field. References are not counted, so compiled functions must not
allocate arrays.
"""
# mypy: disable-error-code="no-untyped-call, untyped-decorator"
# Numba has few types.

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any, TypeVar, cast
from zlib import crc32

import numba
from llvmlite import binding, ir
from numba import _dynfunc  # type: ignore[attr-defined]
from numba.core import cgutils, types
from numba.core.boxing import unbox_tuple
from numba.core.caching import FunctionCache
from numba.core.codegen import CodeLibrary, JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import PassManager, register_pass
from numba.core.datamodel.models import PrimitiveModel
from numba.core.datamodel.registry import register_default
from numba.core.imputils import lower_getattr_generic
from numba.core.pythonapi import NativeValue, unbox
from numba.core.typed_passes import NativeLowering, NopythonRewrites
from numba.core.typing.typeof import typeof_impl

from vstatics.synthesis.code_cache import CACHE, CACHE_TROUBLE, private

Shared = TypeVar("Shared", bound=type)
Compiled = TypeVar("Compiled", bound=Callable[..., Any])


class _CachedCode(FunctionCache):
    """Cache of machine code in files. Unreadable files are replaced by new compilation."""

    @contextmanager
    def _guard_against_spurious_io_errors(self) -> Iterator[None]:
        """Record errors when a cache file is read or written, instead of raising them."""
        try:
            with private():
                yield
        except RuntimeError:  # code that is not ready to be stored is compiled again
            pass
        except Exception as error:  # noqa: BLE001 - a damaged pickle can raise anything
            CACHE_TROUBLE.append(f"{CACHE}: {type(error).__name__}: {error}")
            with suppress(Exception):
                self.flush()


class SharedType(types.NamedTuple):
    """Numba type of a named tuple that compiled functions receive by address."""

    def __init__(self, fields: Sequence[Any], cls: type) -> None:
        """Create the type with a short name, which names of compiled functions contain."""
        super().__init__(fields, cls)
        self.name = f"{cls.__name__}{crc32(self.name.encode()):08x}"

    @property
    def key(self) -> str:
        """Key of the type in Numba's tables of types."""
        return str(self.name)


@register_default(SharedType)
class SharedModel(PrimitiveModel):
    """Numba data model of a shared tuple: the address of the fields."""

    def __init__(self, models: Any, shared: SharedType) -> None:
        """Determine the data models of the fields."""
        fields = [models.lookup(field).get_value_type() for field in shared.types]
        super().__init__(models, shared, ir.LiteralStructType(fields).as_pointer())


@unbox(SharedType)
def _unbox(shared: SharedType, value: Any, context: Any) -> NativeValue:
    unboxed = unbox_tuple(types.NamedTuple(shared.types, shared.instance_class), value, context)
    address = cgutils.alloca_once_value(context.builder, unboxed.value)
    return NativeValue(address, is_error=unboxed.is_error, cleanup=unboxed.cleanup)


@lower_getattr_generic(SharedType)
def _field(_: Any, builder: Any, shared: SharedType, address: Any, name: str) -> Any:
    index = shared.fields.index(name)
    field = builder.load(cgutils.gep_inbounds(builder, address, 0, index))
    field.set_metadata("invariant.load", builder.module.add_metadata([]))
    return field


def shared(cls: Shared) -> Shared:
    """Register a named tuple whose instances compiled functions receive by address."""

    @typeof_impl.register(cls)
    def of_tuple(value: Any, context: Any) -> SharedType:
        return SharedType([typeof_impl(field, context) for field in value], cls)

    return cls


class _WholeCode(JITCodeLibrary):
    """Machine code of a function and of all parts that it calls."""

    def add_linking_library(self, library: CodeLibrary) -> None:
        """Add the code of a called function, and of all parts that this function calls."""
        for code in (library, *getattr(library, "parts", ())):
            super().add_linking_library(code)

    def add_llvm_module(self, ll_module: Any) -> None:
        """Add the code of a module without optimisation."""
        self._final_module.link_in(ll_module)

    def finalize(self) -> None:
        """Link parts first, because the linker drops functions that no part has called yet."""
        self._linking_libraries.sort(key=lambda code: not isinstance(code, _PartCode))
        super().finalize()

    def _optimize_final_module(self) -> None:
        for function in self._final_module.functions:
            if function.linkage == binding.Linkage.weak_odr:
                function.linkage = "internal"
            elif function.linkage == binding.Linkage.external and not function.is_declaration:
                # fields are constant only within the function
                function.add_function_attribute("noinline")
        if not hasattr(binding, "create_pass_builder"):  # an old version of llvmlite
            super()._optimize_final_module()
            return
        tuning = binding.create_pipeline_tuning_options(speed_level=2)
        tuning.loop_unrolling = tuning.loop_vectorization = False  # most loops are short
        builder = binding.create_pass_builder(self._codegen._tm, tuning)  # noqa: SLF001
        builder.getModulePassManager().run(self._final_module, builder)


class _PartCode(_WholeCode):
    """Code of a function that only compiled functions call."""

    @property
    def parts(self) -> list[CodeLibrary]:
        """Code of all functions that the part calls, directly or indirectly."""
        return list(self._linking_libraries)

    def finalize(self) -> None:
        """Omit machine code, which the linker generates only for callers."""
        for function in self._final_module.functions:
            if not function.is_declaration:
                function.linkage = "weak_odr"
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)
class _LowerWhole(NativeLowering):
    """Translation of a function that Python calls."""

    _name = "lower_whole"

    def run_pass(self, state: Any) -> bool:
        """Translate a function, link the parts and generate machine code."""
        state.library = _WholeCode(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return bool(super().run_pass(state))


@register_pass(mutates_CFG=True, analysis_only=False)
class _LowerPart(NativeLowering):
    """Translation of a function that only compiled functions call."""

    _name = "lower_part"

    def run_pass(self, state: Any) -> bool:
        """Translate a function, and register the translation for callers."""
        state.library = _PartCode(state.targetctx.codegen(), state.func_id.func_qualname)
        state.flags.no_compile = True
        super().run_pass(state)
        lowered = state["cr"]
        described = lowered.fndesc
        entry = _dynfunc.make_function(  # placeholder that represents the part and cannot be called
            described.lookup_module(), described.qualname, "", 0, lowered.env, ()
        )
        state["cr"] = lowered._replace(cfunc=entry)
        state.targetctx.insert_user_function(entry, described, [state.library])
        return True


class _WholeCompiler(CompilerBase):
    """Compiler of functions that Python calls."""

    lowering: type[NativeLowering] = _LowerWhole

    def define_pipelines(self) -> list[PassManager]:
        """Return Numba's compiler passes without the passes for array expressions."""
        manager = DefaultPassBuilder.define_nopython_pipeline(self.state)
        manager.passes = [
            (self.lowering if each is NativeLowering else each, purpose)
            for each, purpose in manager.passes
            if each is not NopythonRewrites
        ]
        manager.finalize()
        return [manager]


class _PartCompiler(_WholeCompiler):
    """Compiler of functions that only compiled functions call."""

    lowering = _LowerPart


def compiled(function: Compiled) -> Compiled:
    """Return a function that is compiled, or loaded from the cache, at the first call."""
    dispatcher = _compiled(function, _WholeCompiler)
    before = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    numba.config.CACHE_DIR = CACHE  # type: ignore[attr-defined]
    try:
        if CACHE and dispatcher is not function:
            with private():
                cache = _CachedCode(function)
            if cache.cache_path.startswith(CACHE):
                dispatcher._cache = cache  # noqa: SLF001 - as in Numba's enable_caching
    except (OSError, RuntimeError) as error:
        CACHE_TROUBLE.append(f"{CACHE}: {error}")
    finally:  # other packages must keep their setting
        numba.config.CACHE_DIR = before  # type: ignore[attr-defined]
    return cast(Compiled, dispatcher)


def compiled_part(function: Compiled) -> Compiled:
    """Return a function that only compiled functions can call."""
    return cast(Compiled, _compiled(function, _PartCompiler, no_cpython_wrapper=True))


def _compiled(function: Compiled, compiler: type[CompilerBase], **options: bool) -> Any:
    numba_compiled: Any = numba.njit  # its types lack some options
    return numba_compiled(
        function,
        nogil=True,
        error_model="numpy",
        pipeline_class=compiler,
        no_cfunc_wrapper=True,
        _nrt=False,
        **options,
    )
