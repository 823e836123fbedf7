"""Words in names of elements, in Chinese, Croatian, Czech, Danish, Finnish, Hungarian, Japanese, Korean, Polish,
Portuguese, Russian and Turkish."""

from __future__ import annotations

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
