"""Functions compiled with Numba, for loops that arrays cannot replace."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any, TypeVar, cast
from zlib import crc32

import numba
from llvmlite.binding import Linkage
from numba import _dynfunc
from llvmlite import ir
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
from numba.core.typed_passes import NativeLowering
from numba.core.typing.typeof import typeof_impl

from vstatics.core.extras import build
from vstatics.core.numerics.arrays import Floats, Integers

Shared = TypeVar("Shared", bound=type)
Compiled = TypeVar("Compiled", bound=Callable[..., Any])

CACHE_TROUBLE: list[str] = []
"""Reasons why machine code could not be stored or read, for the command to report."""


def _cache() -> str:
    """Return a folder for machine code in which no other user can write, or "".

    The path is resolved once, and its folders are checked from the root on, so that nobody can
    exchange a folder that is checked later. The name of the folder depends on the compiled files
    and on the tolerances in them, so that machine code of other versions is never used.
    """
    home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")  # noqa: PTH111
    name = build(b"import compiled", b"Tolerances of")
    folder = os.path.realpath(os.path.join(home, "vstatics", name))  # noqa: PTH118
    try:
        path = ""
        for part in folder.split(os.sep):  # noqa: PTH206 - imports of pathlib cost start-up time
            path += part + os.sep
            with suppress(FileExistsError):
                os.mkdir(path, mode=0o700)  # noqa: PTH102
            _check(path, may_be_shared=True)
        _check(folder)
        for inner, folders, names in os.walk(folder):
            for name in (*folders, *names):
                with suppress(FileNotFoundError):  # another process has just finished a file
                    _check(os.path.join(inner, name))  # noqa: PTH118
        if not os.access(folder, os.W_OK):
            CACHE_TROUBLE.append(f"{folder} can't be written")
            return ""
    except OSError as error:
        CACHE_TROUBLE.append(f"{error.filename or folder}: {error.strerror}")
        return ""
    return folder


def _check(path: str, *, may_be_shared: bool = False) -> None:
    """Refuse a file or folder that users other than the present user and root can change.

    Parameters
    ----------
    path : str
    may_be_shared : bool
        True if others may write in a folder whose sticky bit protects the files of each user.

    Raises
    ------
    OSError
        If the file or folder is refused.
    """
    status = os.lstat(path)
    mode = status.st_mode
    if not (stat.S_ISDIR(mode) or stat.S_ISREG(mode)):
        why = "is neither a file nor a folder"
    elif status.st_uid not in (os.geteuid(), ROOT):
        why = "has another owner"
    elif mode & 0o022 and not (may_be_shared and mode & stat.S_ISVTX):
        why = "others may write there (chmod go-w)"
    else:
        return
    raise PermissionError(errno.EPERM, why, path)


@contextmanager
def _private() -> Iterator[None]:
    """Create files that no other user can write."""
    before = os.umask(0o077)
    try:
        yield
    finally:
        os.umask(before)


ROOT = 0
"""Number of the user who can change every file."""
CACHE = _cache()
"""Folder for machine code; empty if no safe folder exists."""


class _CachedCode(FunctionCache):
    """Machine code in files; unreadable code is compiled again."""

    @contextmanager
    def _guard_against_spurious_io_errors(self) -> Iterator[None]:
        """Guard each reading and writing against any fault of a file."""
        try:
            with _private():
                yield
        except RuntimeError:  # the code is not ready to be stored yet; Numba compiles it again
            pass
        except Exception as error:  # noqa: BLE001 - a damaged pickle may raise anything
            CACHE_TROUBLE.append(f"{CACHE}: {type(error).__name__}: {error}")
            with suppress(Exception):
                self.flush()  # type: ignore[no-untyped-call] # Numba has no types


class SharedType(types.NamedTuple):
    """Type of a named tuple of which compiled functions receive the address."""

    def __init__(self, fields: Sequence[Any], cls: type) -> None:
        """Use a short name, because it is part of the names of all functions."""
        super().__init__(fields, cls)
        self.name = f"{cls.__name__}{crc32(self.name.encode()):08x}"

    @property
    def key(self) -> str:
        """Key in tables of types."""
        return str(self.name)


@register_default(SharedType)
class SharedModel(PrimitiveModel):
    """Address of the fields of a shared tuple."""

    def __init__(self, models: Any, shared: SharedType) -> None:
        """Find the types of the fields."""
        fields = [models.lookup(field).get_value_type() for field in shared.types]
        super().__init__(models, shared, ir.LiteralStructType(fields).as_pointer())


@unbox(SharedType)
def _unbox(shared: SharedType, value: Any, context: Any) -> NativeValue:
    unboxed = unbox_tuple(types.NamedTuple(shared.types, shared.instance_class), value, context)
    address = cgutils.alloca_once_value(context.builder, unboxed.value)
    return NativeValue(address, is_error=unboxed.is_error, cleanup=unboxed.cleanup)


@lower_getattr_generic(SharedType)
def _field(context: Any, builder: Any, shared: SharedType, address: Any, name: str) -> Any:
    index = shared.fields.index(name)
    field = builder.load(cgutils.gep_inbounds(builder, address, 0, index))
    field.set_metadata("invariant.load", builder.module.add_metadata([]))
    return field


def shared(cls: Shared) -> Shared:
    """Let compiled functions receive the address of a named tuple."""

    @typeof_impl.register(cls)
    def of_tuple(value: Any, context: Any) -> SharedType:
        return SharedType([typeof_impl(field, context) for field in value], cls)

    return cls


class _Whole(JITCodeLibrary):
    """Code of a function with all parts that it calls, which is optimised only here."""

    def add_linking_library(self, library: CodeLibrary) -> None:
        """Add the code of a part and of all parts that it calls."""
        for each in (library, *getattr(library, "parts", ())):
            super().add_linking_library(each)

    def finalize(self) -> None:
        self._linking_libraries.sort(key=lambda each: not isinstance(each, _Part))
        super().finalize()

    def _optimize_final_module(self) -> None:
        for function in self._final_module.functions:
            if function.linkage == Linkage.weak_odr:
                function.linkage = "internal"
            elif function.linkage == Linkage.external and not function.is_declaration:
                function.add_function_attribute("noinline")
        manager, builder = self._codegen._module_pass_manager()
        manager.run(self._final_module, builder)


class _Part(_Whole):
    """Code of a function that only other compiled functions contain."""

    @property
    def parts(self) -> list[CodeLibrary]:
        """Code of all parts that this part calls."""
        return self._linking_libraries

    def add_llvm_module(self, ll_module: Any) -> None:
        self._final_module.link_in(ll_module)

    def finalize(self) -> None:
        """Leave the code as it is until it is linked."""
        for function in self._final_module.functions:
            if not function.is_declaration:
                function.linkage = "weak_odr"
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)
class _LowerWhole(NativeLowering):
    _name = "lower_whole"

    def run_pass(self, state: Any) -> bool:
        state.library = _Whole(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return super().run_pass(state)


@register_pass(mutates_CFG=True, analysis_only=False)
class _LowerPart(NativeLowering):
    _name = "lower_part"

    def run_pass(self, state: Any) -> bool:
        state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)
        state.flags.no_compile = True
        super().run_pass(state)
        lowered = state["cr"]
        entry = _dynfunc.make_function(
            lowered.fndesc.lookup_module(), lowered.fndesc.qualname, "", 0, lowered.env, ()
        )
        state["cr"] = lowered._replace(cfunc=entry)
        state.targetctx.insert_user_function(entry, lowered.fndesc, [state.library])
        return True


class _Compiler(CompilerBase):
    lowering = _LowerWhole

    def define_pipelines(self) -> list[PassManager]:
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.passes = [
            (self.lowering if each is NativeLowering else each, name) for each, name in passes.passes
        ]
        passes.finalize()
        return [passes]


class _PartCompiler(_Compiler):
    lowering = _LowerPart


def compiled(function: Compiled) -> Compiled:
    """Return a function that is compiled at the first call, or loaded as stored machine code."""
    return _compiled(function, pipeline_class=_Compiler, no_cfunc_wrapper=True, _nrt=False)


def compiled_part(function: Compiled) -> Compiled:
    """Return a function that only compiled functions call, and that allocates no array.

    It takes half the time to compile, because it needs no conversion of Python objects and no
    counting of references.
    """
    options = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True, "_nrt": False}
    return cast(Compiled, numba.njit(function, nogil=True, error_model="numpy", pipeline_class=_PartCompiler, **options))


def _compiled(function: Compiled, **options: Any) -> Compiled:
    dispatcher = numba.njit(function, nogil=True, error_model="numpy", **options)
    before = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    numba.config.CACHE_DIR = CACHE  # type: ignore[attr-defined]
    try:
        if CACHE and dispatcher is not function:
            with _private():
                cache = _CachedCode(function)  # type: ignore[no-untyped-call]
            if cache.cache_path.startswith(CACHE):
                dispatcher._cache = cache  # noqa: SLF001 - as its own enable_caching does
    except (OSError, RuntimeError) as error:
        CACHE_TROUBLE.append(f"{CACHE}: {error}")
    finally:  # other packages' functions are stored where they want
        numba.config.CACHE_DIR = before  # type: ignore[attr-defined]
    return cast(Compiled, dispatcher)


@compiled
def put(values: Floats | Integers, into: Floats | Integers) -> None:
    """Copy an array; an assignment of slices would take seconds to compile."""
    for place in range(len(values)):
        into[place] = values[place]


@compiled_part
def fill(into: Floats | Integers, value: float) -> None:
    """Fill an array with a value."""
    for place in range(len(into)):
        into[place] = value
