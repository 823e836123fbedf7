"""Kinds of elements: members, or elements that carry nothing, by class, type, part of the bridge and name.

Words in names are in English, and in Chinese, Croatian, Czech, Danish, Finnish, Hungarian, Japanese, Korean, Polish,
Portuguese, Russian and Turkish.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from .settings import matches

MORE_WORDS = {
    "left out": (
        r"guarda.corpo|corrimão|barierk|balustrad|por[eę]cz|zábradl|svodid|rækværk|autoværn|\bkaide"
        r"|перил|ограждени"
        r"|арматур|\bograda|\barmatura|korkuluk|donat[ıi]|korlát|vasalás|栏杆|欄杆|护栏|護欄|钢筋|鋼筋"
        r"|鉄筋|排水|照明"
        r"|(?<!壁)高欄|난간|철근|배수"
    ),
    "approach slab": (
        r"laje de transi|płyta przejściowa|přechodov|overgangsplade|siirtymälaat|переходн\w+ плит"
        r"|prijelazna ploča"
        r"|yaklaş[ıi]m (döşeme|plağ)|kiegyenlítő lemez|搭板|踏掛|접속 ?슬래브|접속판"
    ),
    "wing wall": (
        r"muros? (de )?ala|skrzyd[łl]|křídl|\bfløj|siipimuuri|откосн\w+ (крыл|стен)|\bкрыл[оь]"
        r"|\bkril[on]|kanat duvar"
        r"|szárnyfal|翼墙|翼牆|翼壁|ウイング|날개벽"
    ),
    "bearing": (
        r"aparelhos? de apoio|łożysk|ložisk|\b(bro)?leje[rt]?\b|laakeri|опорн\w+ част|\bležaj|mesnet"
        r"|\bsaru\b|支座|支承|교좌|받침"
    ),
    "cross girder": (
        r"transversina|poprzecznic|příčník|tværdrager|tværbjælke|poikkipalk|поперечн\w+ балк|диафрагм"
        r"|poprečni nosač"
        r"|enleme|kereszttartó|横梁|橫梁|横隔|橫隔|横桁|가로보"
    ),
    "pier cap": (
        r"capitel|\btravessa|oczep|úložný práh|overligger|tukipalk|\bригел|насадк|naglavn|başl[ıi]k kiriş"
        r"|fejgerenda|盖梁|蓋梁|帽梁"
        r"|橋脚梁|코핑|두부보"
    ),
    "footing": (
        r"\bsapata|funda[cç][aã]o|bloco de coroamento|\bława|základ|perustus|antura|peruslaat|фундамент"
        r"|ростверк"
        r"|\btemel|radye|alaptest|alapozás|承台|基础|基礎|フーチング|기초"
    ),
    "abutment": (
        r"\bencontro|przycz[óo][łl]|\bopěr|landfæste|endevederlag|maatuki|\bусто[йи]|upornja|kenar ?ayak"
        r"|hídfő|桥台|橋台"
        r"|교대"
    ),
    "parapet": r"gzyms|římsa|kantbjælke|reunapalk|карниз|парапет|vijenac|\bbordür|防撞墙|防撞牆|壁高欄|地覆|방호벽",
    "arch": r"\bł(uk|ęk)|oblouk|\bkaari|\bарк[аи]|\bсвод|\bluk\b|\bkemer|boltív|拱圈|拱肋|主拱|アーチ|아치",
    "fill": (
        r"aterro|enchimento|zasypk|zásyp|opfyldning|täyttö|засыпк|\bnasip|\bzasip|dolgu|töltés"
        r"|填土|回填|盛土|裏込|채움"
    ),
    "pier": (
        r"\bfilar|\bsłup|podpor|pilíř|\bsloup|\bpille|søjle|välituki|\bpilari|pylvä|\bопор|\bколонн"
        r"|стойк|\bcoluna|\bstup|\bayak\b|\bayağ[ıi]"
        r"|\bkolon|pillér|oszlop|桥墩|橋墩|墩柱|墩身|橋脚|柱|교각|기둥"
    ),
    "bracing": (
        r"contraventamento|st[eę]żen|ztuž|vindkryds|tuuliside|vinoside|\bсвяз[ьи]|раскос|\bspreg|çapraz"
        r"|szélrács|\brács|vinosit|横撑|橫撐|가새"
        r"|横联|橫聯|平联|联结系|横構|対傾構|브레이싱"
    ),
    "girder": (
        r"longarina|d[źz]wigar|\bbelk|nosník|\btrám|drager|bjælke|palkki|kannatin|kannattaj|\bбалк|nosač"
        r"|\bgred[ae]|kiriş"
        r"|gerenda|főtartó|梁|桁|거더|주형"
    ),
    "deck": (
        r"tabuleiro|\blaje|\bpłyt|pomost|mostovk|\bdeska|brodæk|\bdækplade|broplade|\bkansi|laatta|\bплит"
        r"|прол[её]тн\w+ строен|kolnička"
        r"|\bploča|tabliye|döşeme|pályalemez|桥面|橋面|床版|바닥판|슬래브|상판"
    ),
}
"""Words by the kind they say, as in `kinds`."""

MORE_WALLS = r"parede|ścian|stěn|\bzeď|\bvæg|seinä|muuri|стен[аы]|\bzid\b|duvar|\bfal\b|墙|牆|壁|벽"


@dataclass(frozen=True, slots=True, kw_only=True)
class ElementFacts:
    """What an IFC file says of an element.

    Attributes
    ----------
    name
        Its class where the file gives no name.
    classes
        Its class, and the classes above it.
    predefined
        Its predefined type, such as ``PIERCAP``; empty without one.
    words
        Its name, object type, predefined type and the name of its type.
    properties
        What its property sets call its type, label or classification.
    parts
        Parts of the bridge that it is in, the smallest first, each as its predefined type and its name.
    number
        Its number in the file; 0 for what is in no file.
    member_name
        Name that it has as a member, which no other has; empty for what is none.
    """

    name: str
    global_id: str
    classes: tuple[str, ...]
    predefined: str = ""
    words: str = ""
    properties: str = ""
    parts: tuple[str, ...] = ()
    number: int = 0
    member_name: str = ""

    @property
    def title(self) -> str:
        """Its name in messages."""
        return f"{self.name} ({self.classes[0]} #{self.number})"

    @property
    def names(self) -> tuple[str, ...]:
        """Names that a user may give it: all that messages call it."""
        return (self.name, self.classes[0], self.global_id, self.member_name, f"#{self.number}", self.title)


@dataclass(frozen=True, slots=True)
class LeftOut:
    """That an element is no member, and why."""

    why: str


_CARRIES_NOTHING = "it carries nothing"

_SURFACING = "surfacing carries nothing; where its mass counts, raise the density of the deck"

_OF_CLASS = {
    "it is counted in the strength of reinforced concrete": ("IfcReinforcingElement",),
    "it lies in the ground, which holds the footings": ("IfcPile",),
    _CARRIES_NOTHING: (
        *("IfcRailing", "IfcSign", "IfcSignal", "IfcFurnishingElement", "IfcDistributionElement"),
        *("IfcTransportElement", "IfcTransportationDevice", "IfcDoor", "IfcWindow", "IfcFastener"),
        *("IfcMechanicalFastener", "IfcDiscreteAccessory", "IfcVibrationDamper", "IfcVibrationIsolator"),
    ),
    _SURFACING: (
        "IfcCovering",
        "IfcCourse",
        "IfcPavement",
        "IfcKerb",
        "IfcRail",
        "IfcTrackElement",
    ),
    "it is part of the ground": ("IfcEarthworksElement", "IfcGeographicElement", "IfcGeotechnicalElement"),
}
"""Classes that are left out, by the reason."""

_OF_TYPE: dict[str | LeftOut, tuple[str, ...]] = {
    "pier cap": ("PIERCAP",),
    "girder": ("GIRDER_SEGMENT", "T_BEAM", "DIAPHRAGM"),
    "pier": ("PIERSTEM", "PIERSTEM_SEGMENT", "STANDCOLUMN"),
    "footing": ("BASESLAB",),
    "parapet": ("PARAPET",),
    "bracing": ("BRACE", "STRUT"),
    "approach slab": ("APPROACH_SLAB",),
    "arch": ("ARCH_SEGMENT",),
    "wing wall": ("WINGWALL",),
    LeftOut("cables are not modelled"): ("STAY_CABLE", "SUSPENSION_CABLE", "SUSPENDER", "STRUCTURALCABLE"),
}
"""Predefined types, whatever the class, by their kind."""

_ALWAYS = {"IfcBearing": "bearing", "IfcFooting": "footing", "IfcCaissonFoundation": "footing", "IfcColumn": "pier"}
"""Kinds of classes that leave no doubt."""

_BY_PART = {
    "IfcBeam": {"pier": "pier cap", "abutment": "pier cap", "substructure": "pier cap"},
    "IfcSlab": {"pier": "pier cap", "abutment": "abutment", "foundation": "footing"},
    "IfcWall": {"pier": "pier", "abutment": "abutment", "foundation": "footing", "deck": "parapet"},
    "IfcPlate": {"pier": "pier", "abutment": "abutment"},
    "IfcMember": {"pier": "pier", "abutment": "abutment"},
    "": {"pier": "pier", "abutment": "abutment", "foundation": "footing", "deck": "deck", "superstructure": "deck"},
}
"""Kinds of a class by the part of the bridge; an empty class stands for all other classes."""

_ELSEWHERE = {"IfcBeam": "girder", "IfcSlab": "deck", "IfcWall": "wall", "IfcPlate": "girder", "IfcMember": "girder"}
"""Kinds of a class in all other parts."""

_NAMED = {
    "IfcBeam": ("pier cap", "cross girder"),
    "IfcSlab": ("footing", "approach slab"),
    "IfcWall": ("abutment", "pier", "parapet", "wing wall"),
}
"""Kinds that the name of an element decides before its part does; for all other classes any kind."""

_OWN_WORDS = {
    "IfcBeam": (
        r"beam|girder|stringer|balk|bjelke|träger|balken|ligger|drager|poutre|\bviga|\btrav[ei]"
        rf"|{MORE_WORDS['girder']}"
    ),
    "IfcSlab": rf"slab|\bdeck|plate\b|platte|dalle|losa|soletta|plaat|platta|{MORE_WORDS['deck']}",
    "IfcWall": rf"wall|wand|vegg|\bmur|muro|vägg|{MORE_WALLS}",
}
"""Words that say of a class what it is anyway; a name without them, such as LANDKAR of a beam, says something else."""

_WORDS = {
    "left out": (
        r"railing|guard ?rail|hand ?rail|tendon|rebar|reinforc|drain|lamp|\blight|\bsign\b|cable"
        r"|rekkverk|geländer|leitplanke|spannglied|bewehrung|glissière|garde corps|armature|barandilla|armadura"
        r"|parapetto|guardrail|leuning|wapening|räcke|armering"
    ),
    "approach slab": (
        r"approach ?slab|overgangsplate|schleppplatte|dalle de transition|losa de transici[oó]n"
        r"|soletta di transizione|stootpla|länkplatt"
    ),
    "wing wall": (
        r"wing ?wall|\bvinge|flügel|mur en (aile|retour)|\baletas?\b|muro d.ala|muri d.ala|vleugel(wand|muur)|vingmur"
    ),
    "bearing": (
        r"bearing|\blager|brückenlager|brulager|brolager|appareils? d.appui|\bapoyos?\b|\bappogg|oplegging|opleggen"
    ),
    "cross girder": (
        r"cross ?(girder|beam)|floor ?beam|transverse (girder|beam)|diaphragm|querträger|tverrbjelke|tverrbærer"
        r"|entretoise|\briostra|diafragma|traverso|dwarsdrager|tvärbalk"
    ),
    "pier cap": (
        r"(pier|bent) ?cap|cap ?beam|cross ?head|hammer ?head|head ?stock|\brigel|pfeilerkopf|querriegel|querhaupt"
        r"|\briegel|chevêtre|cabezal|\bdintel|pulvino"
    ),
    "footing": (
        r"footing|foundation|pile ?cap|base ?slab|fundament|\bsåle|semelle|fondation|zapata|cimentaci[oó]n|encepado"
        r"|plinto|fondazion|zattera|fundering|\bpoer|bottenplatta|grundplatta"
    ),
    "abutment": r"abutment|\babut|back ?wall|landkar|widerlager|cul[eé]e|estribo|\bspall[ae]\b|landhoofd|landfäste",
    "parapet": (
        r"parapet|edge ?beam|kantdrager|kantbjelke|kantbalk|\bkappe|randelement|schampkant|corniche|imposta|cordolo"
    ),
    "arch": r"\barch|bogen|\bbue\b|bueelement|hvelv|gewölbe|voûte|\barco\b|\bbåge|\bboog",
    "fill": (
        r"\b(back ?)?fill|hinterfüllung|verfüllung|auffüllung|remblai|remplissage|relleno|riempimento|rinfianco"
        r"|fylling|fyllmasse|fyllning|aanvulling|\bvulling"
    ),
    "pier": (
        r"\bpier|column|pylon|\bbent\b|søyle|\bpilar|pfeiler|stütze|\bpilas?\b|columna|colonn[ae]|pijler|\bkolom"
        r"|\bpelare|brostöd"
    ),
    "bracing": r"bracing|\bbrace|cross ?frame|verband|contreventement|arriostramiento|controvent|windverband|vindkryss",
    "girder": (r"girder|\bbeam|stringer|bjelke|träger|poutre|\bvigas?\b|\btrav[ei]\b|\bligger|huvudbalk|\bbalk"),
    "deck": (
        r"\bdeck|\bslab|superstructure|brudekke|brodekke|bruplate|overbygning|überbau|fahrbahn|tablier|hourdis|tablero"
        r"|\blosa|impalcato|soletta|brugdek|rijdek|broban[ae]|farbana|överbyggnad"
    ),
}
"""Words in names, in English, Norwegian, German, French, Spanish, Italian, Dutch and Swedish; the first kind counts."""

_WORDS = {kind: f"{words}|{MORE_WORDS[kind]}" for kind, words in _WORDS.items()}

_SURFACING_WORDS = (
    r"asphalt|surfacing|wearing (course|surface)|road ?surface|waterproof|membrane|slitelag|slidlager|belegning"
    r"|(fahrbahn|brücken|asphalt|straßen)belag|\bbelag|deckschicht|abdichtung|enrobé|étanchéité|couche de roulement"
    r"|asfalt|beläggning|tätskikt|mezcla bituminosa|capa de rodadura|conglomerato bituminoso|usura|deklaag"
)
"""Words in the name of what lies on a deck, whatever its class: programs have it as slabs."""

_PILE = r"\bpiles?\b"
_FRENCH = r"cul[eé]e|tablier|chevêtre|semelle|appui|poutre"
"""Words of a file in which a *pile* is a pier; in English it lies in the ground."""

_PARTS = {
    "pier": r"\bpiers?\b|pier_segment|pylon|\bbents?\b|pfeiler|\bpilar|\bpilas?\b|pijler",
    "abutment": r"abutment|widerlager|landkar|cul[eé]e|estribo|\bspall[ae]\b|landhoofd|landfäste",
    "foundation": r"foundation|footing|fundament|fondation|cimentaci|fondazion|fundering",
    "deck": r"\bdeck|surfacestructure",
    "superstructure": r"superstructure",
    "substructure": r"substructure",
}
"""Words in the names and types of parts of a bridge."""

_PARTS |= {
    part: f"{_PARTS[part]}|{MORE_WORDS[kind]}"
    for part, kind in (("pier", "pier"), ("abutment", "abutment"), ("foundation", "footing"), ("deck", "deck"))
}

OTHER = "neither its class nor its name says what it is: give its kind by --kind, as in --kind 'NAME=deck'"


def kind_of(facts: ElementFacts, own: Sequence[tuple[str, str]] = (), *, is_french: bool = False) -> str | LeftOut:
    """Return the kind of an element, or why it is left out; names and kinds of the user's own come first."""
    for pattern, own_kind in own:
        if matches(pattern, facts.names):
            return own_kind
    for why, classes in _OF_CLASS.items():
        if not set(classes).isdisjoint(facts.classes):
            return LeftOut(why)
    if re.search(_SURFACING_WORDS, _plain(facts.words)):
        return LeftOut(_SURFACING)
    if _named_kind(facts.words) == "cross girder":
        return "girder"  # some programs give it the type of a pier cap, which it lies on
    for kind, types in _OF_TYPE.items():
        if facts.predefined in types:
            return kind
    return _of_class(facts, is_french=is_french)


def is_french(words: Sequence[str]) -> bool:
    """Return whether the names of a file are French."""
    return any(re.search(_FRENCH, _plain(text)) for text in words)


def _of_class(facts: ElementFacts, *, is_french: bool) -> str | LeftOut:
    for name, kind in _ALWAYS.items():
        if name in facts.classes:
            return kind
    known = next((cls for cls in facts.classes if cls in _ELSEWHERE), "")
    by_name = _by_name(facts, known, is_french=is_french)
    if by_name:
        return LeftOut(_CARRIES_NOTHING) if by_name == "left out" else by_name
    part = _part_of(facts.parts)
    by_properties = "" if known else _named_kind(facts.properties)
    if by_properties and by_properties != "left out":
        return "girder" if by_properties == "cross girder" else by_properties
    return _BY_PART[known].get(part) or _ELSEWHERE.get(known) or LeftOut(OTHER)


def _by_name(facts: ElementFacts, known: str, *, is_french: bool) -> str:
    """Return the kind that the name of an element decides; empty where it leaves that to class and part."""
    by_name = _named_kind(facts.words)
    if not by_name and is_french and re.search(_PILE, _plain(facts.words)):
        by_name = "pier"
    if not by_name or (known and by_name == "left out" and known in _NAMED):
        return ""
    says_more = known in _OWN_WORDS and not re.search(_OWN_WORDS[known], _plain(facts.words))
    if by_name in _NAMED.get(known, _WORDS) or says_more:
        return by_name.replace("cross girder", "girder")
    return ""


def _named_kind(words: str) -> str:
    plain = _plain(words)
    return next((kind for kind, pattern in _WORDS.items() if re.search(pattern, plain)), "")


def _plain(words: str) -> str:
    return re.sub(r"[_\-.:'\u2019]+", " ", _apart(words))


def _apart(words: str) -> str:
    """Return words in small letters, apart from each other in names such as BoxBeam_01; small i from Turkish İ, too."""
    apart = re.sub(r"(?<=[a-zß-ÿ])(?=[A-ZÀ-Þ])|(?<=[A-Z])(?=[A-Z][a-z])", " ", words)
    return apart.lower().replace("\u0307", "")


def _part_of(parts: tuple[str, ...]) -> str:
    return next((kind for part in parts for kind, words in _PARTS.items() if re.search(words, _apart(part))), "")
