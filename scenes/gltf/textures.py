"""Textures, samplers and images (glTF 2.0, sections 3.8 and 3.9; KHR_texture_transform)."""

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.gltf import document
from lightmeter.scenes.gltf.source import Source
from lightmeter.scenes.images import LARGEST, read_image
from lightmeter.scenes.model import Image, MinFilter, Texture, Wrap

WRAPS: dict[int, Wrap] = {33071: "clamp", 33648: "mirror", 10497: "repeat"}
MIN_FILTERS: dict[int | None, MinFilter] = {
    None: "linear_mipmap_linear",
    9728: "nearest",
    9729: "linear",
    9984: "nearest_mipmap_nearest",
    9985: "linear_mipmap_nearest",
    9986: "nearest_mipmap_linear",
    9987: "linear_mipmap_linear",
}
OTHER_FORMATS = {
    "KHR_texture_basisu": "KTX2",
    "EXT_texture_webp": "WebP",
    "EXT_texture_avif": "AVIF",
    "MSFT_texture_dds": "DDS",
}
MOST_TEXELS = 4 * LARGEST


class Textures:
    """The textures of one file; each image is read once, when it is first needed."""

    def __init__(self, source: Source):
        self._source = source
        self._images: dict[int, Image] = {}
        self._texels = 0

    def texture(self, info: document.TextureInfo | None, srgb: bool, place: str) -> Texture | None:
        """The texture that a material refers to, or None where there is none that can be read (with a note).

        Raises:
            SceneError: a reference is wrong, or the image is missing, damaged or too large.
        """
        if info is None:
            return None
        source, file = self._source, self._source.document
        here = f"textures[{info.index}]"
        texture = source.get("textures", file.textures, info.index, f"{place}.index")
        if texture.source is None:
            formats = [name for key, name in OTHER_FORMATS.items() if key in texture.extensions]
            why = f"its image is {formats[0]}" if formats else "it names no image"
            source.note(f"{here} ({place}) is left out of both pictures: {why}")
            return None
        sampler = document.Sampler.model_validate({})
        if texture.sampler is not None:
            sampler = source.get("samplers", file.samplers, texture.sampler, f"{here}.sampler")
        transform = source.extension(info, "KHR_texture_transform", document.TextureTransform, place)
        transform = transform or document.TextureTransform.model_validate({})
        return Texture(
            image=self._image(texture.source, here),
            srgb=srgb,
            wrap_u=WRAPS[sampler.wrap_s],
            wrap_v=WRAPS[sampler.wrap_t],
            min_filter=MIN_FILTERS[sampler.min_filter],
            mag_filter="nearest" if sampler.mag_filter == 9728 else "linear",
            texcoord=info.texcoord if transform.texcoord is None else transform.texcoord,
            offset=transform.offset,
            rotation=transform.rotation,
            scale=transform.scale,
        )

    def _image(self, index: int, place: str) -> Image:
        if index not in self._images:
            source = self._source
            image = source.get("images", source.document.images, index, f"{place}.source")
            here = f"images[{index}]"
            if image.uri is not None:
                data, name = source.fetch(image.uri, f"{here}.uri"), image.uri
            elif image.buffer_view is not None:
                data, name = bytes(source.view(image.buffer_view, f"{here}.bufferView")[0]), here
            else:
                raise SceneError("the image has neither uri nor bufferView", where=source.at(here))
            name = image.name or (here if name.startswith("data:") else name)
            read = read_image(data, name, source.at(here))
            self._texels += read.texels.shape[0] * read.texels.shape[1]
            if self._texels > MOST_TEXELS:
                raise SceneError(
                    "the images are too large together",
                    where=source.at(here),
                    expected=f"at most {MOST_TEXELS} texels",
                )
            self._images[index] = read
        return self._images[index]
